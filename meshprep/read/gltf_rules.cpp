#include "meshprep/read/gltf_rules.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace malus::prep::gltf {

namespace {

constexpr Rule noted(std::string_view path, std::string_view note) { return {path, Type::noted, 0, false, note}; }
constexpr Rule optionalValue(std::string_view path, Type type, std::size_t size = 0) {
  return {path, type, size, false, {}, Invalid::value};
}
constexpr Rule optionalPart(std::string_view path, Type type, std::size_t size = 0) {
  return {path, type, size, false, {}, Invalid::part};
}

// The keys of a texture's place: its coordinates and KHR_texture_transform.
#define MALUS_TEXTURE_RULES(path)                                                                    \
  optionalValue(path, Type::object), Rule{path "/index", Type::index, 0, true},                      \
      optionalValue(path "/texCoord", Type::index), optionalValue(path "/extensions", Type::object), \
      optionalValue(path "/extensions/KHR_texture_transform", Type::object),                         \
      optionalValue(path "/extensions/KHR_texture_transform/offset", Type::numbers, 2),              \
      optionalValue(path "/extensions/KHR_texture_transform/scale", Type::numbers, 2),               \
      optionalValue(path "/extensions/KHR_texture_transform/rotation", Type::number),                \
      optionalValue(path "/extensions/KHR_texture_transform/texCoord", Type::index)

// Paths have no indices of arrays.
constexpr std::array kRules = {
    Rule{"asset", Type::object, 0, true},
    Rule{"asset/version", Type::text, 0, true},
    Rule{"asset/minVersion", Type::text},
    optionalValue("extensionsUsed", Type::texts),
    optionalValue("extensionsRequired", Type::texts),
    optionalValue("scene", Type::index),
    Rule{"scenes", Type::objects},
    Rule{"scenes/nodes", Type::indices},
    Rule{"nodes", Type::objects},
    optionalValue("nodes/name", Type::text),
    optionalPart("nodes/mesh", Type::index),
    optionalPart("nodes/children", Type::indices),
    optionalPart("nodes/matrix", Type::numbers, 16),
    optionalPart("nodes/translation", Type::numbers, 3),
    optionalPart("nodes/rotation", Type::numbers, 4),
    optionalPart("nodes/scale", Type::numbers, 3),
    optionalPart("nodes/skin", Type::index),
    optionalValue("nodes/weights", Type::numberList),
    optionalValue("nodes/camera", Type::index),
    optionalValue("nodes/extensions", Type::object),
    optionalPart("nodes/extensions/EXT_mesh_gpu_instancing", Type::object),
    Rule{"nodes/extensions/EXT_mesh_gpu_instancing/attributes", Type::object, 0, true},
    Rule{"nodes/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION", Type::index},
    Rule{"nodes/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION", Type::index},
    Rule{"nodes/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", Type::index},
    optionalValue("nodes/extensions/KHR_lights_punctual", Type::object),
    Rule{"nodes/extensions/KHR_lights_punctual/light", Type::index, 0, true},
    Rule{"meshes", Type::objects},
    optionalValue("meshes/name", Type::text),
    optionalValue("meshes/weights", Type::numberList),
    Rule{"meshes/primitives", Type::objects, 0, true},
    Rule{"meshes/primitives/mode", Type::index},
    Rule{"meshes/primitives/indices", Type::index},
    Rule{"meshes/primitives/material", Type::index},
    Rule{"meshes/primitives/attributes", Type::object, 0, true},
    Rule{"meshes/primitives/attributes/POSITION", Type::index},
    Rule{"meshes/primitives/attributes/NORMAL", Type::index},
    Rule{"meshes/primitives/attributes/TANGENT", Type::unchecked},
    Rule{"meshes/primitives/attributes/TEXCOORD_0", Type::unchecked},
    Rule{"meshes/primitives/attributes/TEXCOORD_1", Type::unchecked},
    noted("meshes/primitives/attributes/COLOR_0", "colours of vertices"),
    Rule{"meshes/primitives/attributes/JOINTS_0", Type::index},
    Rule{"meshes/primitives/attributes/WEIGHTS_0", Type::index},
    Rule{"meshes/primitives/attributes/JOINTS_1", Type::index},
    Rule{"meshes/primitives/attributes/WEIGHTS_1", Type::index},
    optionalValue("meshes/primitives/targets", Type::objects),
    Rule{"meshes/primitives/targets/POSITION", Type::index},
    Rule{"meshes/primitives/targets/NORMAL", Type::index},
    Rule{"meshes/primitives/targets/TANGENT", Type::unchecked},
    Rule{"meshes/primitives/extensions", Type::object},
    noted("meshes/primitives/extensions/KHR_materials_variants", "material variants (the default is used)"),
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression", Type::object},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/bufferView", Type::index, 0, true},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes", Type::object, 0, true},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/POSITION", Type::index},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/NORMAL", Type::index},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/TANGENT", Type::unchecked},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/TEXCOORD_0", Type::unchecked},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/TEXCOORD_1", Type::unchecked},
    Rule{"accessors", Type::objects},
    Rule{"accessors/bufferView", Type::index},
    Rule{"accessors/byteOffset", Type::size},
    Rule{"accessors/componentType", Type::index, 0, true},
    Rule{"accessors/normalized", Type::flag},
    Rule{"accessors/count", Type::size, 0, true},
    Rule{"accessors/type", Type::text, 0, true},
    Rule{"accessors/sparse", Type::object},
    Rule{"accessors/sparse/count", Type::index, 0, true},
    Rule{"accessors/sparse/indices", Type::object, 0, true},
    Rule{"accessors/sparse/indices/bufferView", Type::index, 0, true},
    Rule{"accessors/sparse/indices/byteOffset", Type::index},
    Rule{"accessors/sparse/indices/componentType", Type::index, 0, true},
    Rule{"accessors/sparse/values", Type::object, 0, true},
    Rule{"accessors/sparse/values/bufferView", Type::index, 0, true},
    Rule{"accessors/sparse/values/byteOffset", Type::index},
    Rule{"bufferViews", Type::objects},
    Rule{"bufferViews/buffer", Type::index, 0, true},
    Rule{"bufferViews/byteOffset", Type::size},
    Rule{"bufferViews/byteLength", Type::size, 0, true},
    Rule{"bufferViews/byteStride", Type::index},
    Rule{"bufferViews/extensions", Type::object},
    Rule{"bufferViews/extensions/EXT_meshopt_compression", Type::object},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/buffer", Type::index, 0, true},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/byteOffset", Type::size},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/byteLength", Type::size, 0, true},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/byteStride", Type::index, 0, true},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/count", Type::size, 0, true},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/mode", Type::text, 0, true},
    Rule{"bufferViews/extensions/EXT_meshopt_compression/filter", Type::text},
    Rule{"buffers", Type::objects},
    optionalValue("buffers/extensions", Type::object),
    optionalValue("buffers/extensions/EXT_meshopt_compression", Type::object),
    optionalValue("buffers/extensions/EXT_meshopt_compression/fallback", Type::flag),
    Rule{"buffers/uri", Type::text},
    Rule{"buffers/byteLength", Type::size, 0, true},
    Rule{"materials", Type::objects},
    optionalValue("materials/name", Type::text),
    optionalValue("materials/pbrMetallicRoughness", Type::object),
    optionalValue("materials/pbrMetallicRoughness/baseColorFactor", Type::numbers, 4),
    optionalValue("materials/pbrMetallicRoughness/metallicFactor", Type::number),
    optionalValue("materials/pbrMetallicRoughness/roughnessFactor", Type::number),
    optionalValue("materials/emissiveFactor", Type::numbers, 3),
    optionalValue("materials/alphaMode", Type::text),
    optionalValue("materials/alphaCutoff", Type::number),
    optionalValue("materials/doubleSided", Type::flag),
    optionalValue("materials/extensions", Type::object),
    optionalValue("materials/extensions/KHR_materials_ior", Type::object),
    optionalValue("materials/extensions/KHR_materials_ior/ior", Type::number),
    optionalValue("materials/extensions/KHR_materials_transmission", Type::object),
    optionalValue("materials/extensions/KHR_materials_transmission/transmissionFactor", Type::number),
    optionalValue("materials/extensions/KHR_materials_volume", Type::object),
    optionalValue("materials/extensions/KHR_materials_volume/thicknessFactor", Type::number),
    optionalValue("materials/extensions/KHR_materials_volume/attenuationDistance", Type::number),
    optionalValue("materials/extensions/KHR_materials_volume/attenuationColor", Type::numbers, 3),
    optionalValue("materials/extensions/KHR_materials_specular", Type::object),
    optionalValue("materials/extensions/KHR_materials_specular/specularFactor", Type::number),
    optionalValue("materials/extensions/KHR_materials_specular/specularColorFactor", Type::numbers, 3),
    noted("materials/extensions/KHR_materials_specular/specularTexture", "specular textures"),
    noted("materials/extensions/KHR_materials_specular/specularColorTexture", "specular textures"),
    optionalValue("materials/extensions/KHR_materials_iridescence", Type::object),
    optionalValue("materials/extensions/KHR_materials_iridescence/iridescenceFactor", Type::number),
    optionalValue("materials/extensions/KHR_materials_iridescence/iridescenceIor", Type::number),
    optionalValue("materials/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", Type::number),
    noted("materials/extensions/KHR_materials_iridescence/iridescenceTexture", "iridescence textures"),
    noted("materials/extensions/KHR_materials_iridescence/iridescenceThicknessTexture", "iridescence textures"),
    optionalValue("materials/extensions/KHR_materials_clearcoat", Type::object),
    optionalValue("materials/extensions/KHR_materials_clearcoat/clearcoatFactor", Type::number),
    optionalValue("materials/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", Type::number),
    noted("materials/extensions/KHR_materials_clearcoat/clearcoatTexture", "clearcoat textures"),
    noted("materials/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", "clearcoat textures"),
    noted("materials/extensions/KHR_materials_clearcoat/clearcoatNormalTexture", "normal textures"),
    optionalValue("materials/extensions/KHR_materials_pbrSpecularGlossiness", Type::object),
    optionalValue("materials/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", Type::numbers, 4),
    optionalValue("materials/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", Type::numbers, 3),
    optionalValue("materials/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", Type::number),
    MALUS_TEXTURE_RULES("materials/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture"),
    MALUS_TEXTURE_RULES("materials/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture"),
    MALUS_TEXTURE_RULES("materials/extensions/KHR_materials_transmission/transmissionTexture"),
    noted("materials/extensions/KHR_materials_volume/thicknessTexture", "thickness textures"),
    MALUS_TEXTURE_RULES("materials/emissiveTexture"),
    optionalValue("materials/extensions/KHR_materials_emissive_strength", Type::object),
    optionalValue("materials/extensions/KHR_materials_emissive_strength/emissiveStrength", Type::number),
    MALUS_TEXTURE_RULES("materials/pbrMetallicRoughness/baseColorTexture"),
    MALUS_TEXTURE_RULES("materials/pbrMetallicRoughness/metallicRoughnessTexture"),
    MALUS_TEXTURE_RULES("materials/normalTexture"),
    optionalValue("materials/normalTexture/scale", Type::number),
    noted("materials/occlusionTexture", "occlusion textures"),
    optionalValue("textures", Type::objects),
    optionalValue("textures/source", Type::index),
    optionalValue("textures/sampler", Type::index),
    optionalValue("samplers", Type::objects),
    optionalValue("samplers/wrapS", Type::index),
    optionalValue("samplers/wrapT", Type::index),
    optionalValue("images", Type::objects),
    optionalValue("images/name", Type::text),
    optionalValue("images/uri", Type::text),
    optionalValue("images/bufferView", Type::index),
    noted("animations", "animations (the default pose is used)"),
    optionalValue("skins", Type::objects),  // without joints if invalid: gltf_pose.h
    Rule{"skins/joints", Type::indices, 0, true},
    Rule{"skins/inverseBindMatrices", Type::index},
    optionalValue("cameras", Type::objects),
    optionalValue("cameras/name", Type::text),
    Rule{"cameras/type", Type::text, 0, true},
    optionalValue("cameras/perspective", Type::object),
    Rule{"cameras/perspective/yfov", Type::number, 0, true},
    optionalValue("cameras/perspective/aspectRatio", Type::number),
    optionalValue("cameras/orthographic", Type::object),
    Rule{"cameras/orthographic/xmag", Type::number, 0, true},
    Rule{"cameras/orthographic/ymag", Type::number, 0, true},
    optionalValue("extensions", Type::object),
    optionalValue("extensions/KHR_lights_punctual", Type::object),
    optionalValue("extensions/KHR_lights_punctual/lights", Type::objects),
    optionalValue("extensions/KHR_lights_punctual/lights/name", Type::text),
    noted("extensions/KHR_materials_variants", "material variants (the default is used)"),
    Rule{"extensions/KHR_lights_punctual/lights/type", Type::text, 0, true},
    optionalValue("extensions/KHR_lights_punctual/lights/color", Type::numbers, 3),
    optionalValue("extensions/KHR_lights_punctual/lights/intensity", Type::number),
    noted("extensions/KHR_lights_punctual/lights/range", "ranges of lights (light falls off with the square)"),
    optionalValue("extensions/KHR_lights_punctual/lights/spot", Type::object),
    optionalValue("extensions/KHR_lights_punctual/lights/spot/innerConeAngle", Type::number),
    optionalValue("extensions/KHR_lights_punctual/lights/spot/outerConeAngle", Type::number),
};

}  // namespace

const Rule* findRule(std::string_view path) {
  static const std::map<std::string_view, const Rule*> kByPath = [] {
    std::map<std::string_view, const Rule*> rules;
    for (const Rule& rule : kRules) rules.emplace(rule.path, &rule);
    return rules;
  }();
  const auto found = kByPath.find(path);
  return found == kByPath.end() ? nullptr : found->second;
}

std::string unknownKeyNote(std::string_view path) {
  // Names and application data may be in every object.
  const std::string_view key = path.substr(path.rfind('/') + 1);
  if (key == "extras" || key == "name" || path.starts_with("asset/")) return {};
  constexpr auto kHarmless = std::to_array<std::string_view>(
      {"accessors/min", "accessors/max", "bufferViews/target", "cameras/perspective/znear", "cameras/perspective/zfar",
       "cameras/orthographic/znear", "cameras/orthographic/zfar", "samplers/magFilter", "samplers/minFilter",
       "skins/skeleton", "materials/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum",
       "images/mimeType"});
  if (std::find(kHarmless.begin(), kHarmless.end(), path) != kHarmless.end()) return {};
  // The coordinates of a texture that is noted itself.
  if (path.find("Texture/texCoord") != std::string_view::npos ||
      path.find("Texture/extensions") != std::string_view::npos)
    return {};
  constexpr std::string_view kAttributes = "meshes/primitives/attributes/_";  // of the application
  if (path.starts_with(kAttributes)) return {};
  constexpr std::string_view kExtensions = "extensions/";
  std::size_t at = path.find(kExtensions);
  if (at != std::string_view::npos && (at == 0 || path[at - 1] == '/')) {
    at += kExtensions.size();
    const std::size_t end = std::min(path.find('/', at), path.size());
    if (findRule(path.substr(0, end)) == nullptr)
      return fmt::format("extension {}", path.substr(at, std::min<std::size_t>(end - at, 60)));
  }
  std::string text(path.substr(0, 100));
  std::replace(text.begin(), text.end(), '/', '.');
  return fmt::format("key '{}'", text);
}

const std::vector<std::string_view>& requiredKeys(std::string_view path) {
  static const std::map<std::string_view, std::vector<std::string_view>> kByPath = [] {
    std::map<std::string_view, std::vector<std::string_view>> keys;
    for (const Rule& rule : kRules) {
      const std::size_t slash = rule.path.rfind('/');
      const bool top = slash == std::string_view::npos;
      if (rule.required)
        keys[top ? std::string_view() : rule.path.substr(0, slash)].push_back(top ? rule.path
                                                                                  : rule.path.substr(slash + 1));
    }
    return keys;
  }();
  static const std::vector<std::string_view> kNone;
  const auto found = kByPath.find(path);
  return found == kByPath.end() ? kNone : found->second;
}

}  // namespace malus::prep::gltf
