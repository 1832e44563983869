#include "meshprep/read/gltf_document.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep::gltf {
using nlohmann::json;

namespace {

constexpr std::size_t kMaxStride = 252;

// Fills `value` if the object has the key with a valid value.
template <class Value>
void get(const json& object, const char* key, Value& value) {
  if (const auto found = object.find(key); found != object.end() && !found->is_null()) found->get_to(value);
}

template <class Value>
void get(const json& object, const char* key, std::optional<Value>& value) {
  if (const auto found = object.find(key); found != object.end() && !found->is_null()) value = found->get<Value>();
}

bool isInvalid(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_null();
}

// The object at a key; an empty object if there is none.
const json& child(const json& object, const char* key) {
  static const json kEmpty = json::object();
  const auto found = object.find(key);
  return found == object.end() ? kEmpty : *found;
}

ComponentType componentType(const json& object, const std::string& location) {
  const auto type = object.at("componentType").get<std::uint32_t>();
  switch (static_cast<ComponentType>(type)) {
    case ComponentType::int8:
    case ComponentType::uint8:
    case ComponentType::int16:
    case ComponentType::uint16:
    case ComponentType::uint32:
    case ComponentType::float32:
      return static_cast<ComponentType>(type);
  }
  throw Error(location + ".componentType", "unknown component type", "5120 to 5123, 5125 or 5126",
              fmt::to_string(type));
}

std::size_t componentCount(const json& accessor, const std::string& location) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kTypes = {
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const auto& type = accessor.at("type").get_ref<const std::string&>();
  const auto* const found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == type; });
  if (found == kTypes.end())
    throw Error(location + ".type", "unknown element type", "SCALAR, VEC2 to VEC4 or MAT2 to MAT4",
                "'" + type.substr(0, 40) + "'");
  return found->second;
}

Accessor toAccessor(const json& object, const std::string& location) {
  Accessor accessor;
  get(object, "bufferView", accessor.bufferView);
  get(object, "byteOffset", accessor.byteOffset);
  accessor.componentType = componentType(object, location);
  get(object, "normalized", accessor.normalized);
  accessor.count = object.at("count").get<std::size_t>();
  accessor.components = componentCount(object, location);
  if (const auto sparse = object.find("sparse"); sparse != object.end()) {
    const json &indices = sparse->at("indices"), &values = sparse->at("values");
    SparseElements elements;
    elements.count = sparse->at("count").get<std::size_t>();
    elements.indicesView = indices.at("bufferView").get<std::size_t>();
    get(indices, "byteOffset", elements.indicesByteOffset);
    elements.indicesType = componentType(indices, location + ".sparse.indices");
    elements.valuesView = values.at("bufferView").get<std::size_t>();
    get(values, "byteOffset", elements.valuesByteOffset);
    accessor.sparse = elements;
  }
  return accessor;
}

BufferView toBufferView(const json& object, const std::string& location) {
  BufferView view;
  view.buffer = object.at("buffer").get<std::size_t>();
  get(object, "byteOffset", view.byteOffset);
  view.byteLength = object.at("byteLength").get<std::size_t>();
  get(object, "byteStride", view.byteStride);
  if (view.byteStride > kMaxStride || view.byteStride % 4 != 0)
    throw Error(location + ".byteStride", "invalid stride", fmt::format("a multiple of 4 up to {}", kMaxStride),
                fmt::to_string(view.byteStride));
  const json& extensions = child(object, "extensions");
  if (const auto found = extensions.find("EXT_meshopt_compression"); found != extensions.end()) {
    MeshoptCompression& meshopt = view.meshopt.emplace();
    get(*found, "buffer", meshopt.buffer);
    get(*found, "byteOffset", meshopt.byteOffset);
    get(*found, "byteLength", meshopt.byteLength);
    get(*found, "byteStride", meshopt.byteStride);
    get(*found, "count", meshopt.count);
    get(*found, "mode", meshopt.mode);
    get(*found, "filter", meshopt.filter);
  }
  return view;
}

// Sets an index that the types of the document do not check, because it may not be used.
template <class Index>
void getUnchecked(const json& object, const char* key, std::optional<Index>& index) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const auto found = object.find(key);
  if (found == object.end()) return;
  const bool isIndex = found->is_number_unsigned() && found->template get<std::uint64_t>() < kMost;
  index = isIndex ? found->template get<Index>() : std::numeric_limits<Index>::max();
}

template <class Result>
void getTextureAttributes(const json& attributes, Result& result) {
  getUnchecked(attributes, "TANGENT", result.tangent);
  getUnchecked(attributes, "TEXCOORD_0", result.texCoords[0]);
  getUnchecked(attributes, "TEXCOORD_1", result.texCoords[1]);
}

Primitive toPrimitive(const json& object) {
  Primitive primitive;
  get(object, "mode", primitive.mode);
  get(object, "indices", primitive.indices);
  get(object, "material", primitive.material);
  const json& attributes = object.at("attributes");
  get(attributes, "POSITION", primitive.position);
  get(attributes, "NORMAL", primitive.normal);
  getTextureAttributes(attributes, primitive);
  get(attributes, "JOINTS_0", primitive.joints[0]);
  get(attributes, "JOINTS_1", primitive.joints[1]);
  get(attributes, "WEIGHTS_0", primitive.weights[0]);
  get(attributes, "WEIGHTS_1", primitive.weights[1]);
  if (const auto targets = object.find("targets"); targets != object.end())
    for (const json& item : *targets) {
      MorphTarget& target = primitive.targets.emplace_back();
      if (item.is_null()) continue;
      get(item, "POSITION", target.position);
      get(item, "NORMAL", target.normal);
      getUnchecked(item, "TANGENT", target.tangent);
    }
  const json& extensions = child(object, "extensions");
  if (const auto found = extensions.find("KHR_draco_mesh_compression"); found != extensions.end()) {
    DracoExtension draco;
    draco.bufferView = found->at("bufferView").get<std::size_t>();
    get(found->at("attributes"), "POSITION", draco.position);
    get(found->at("attributes"), "NORMAL", draco.normal);
    getTextureAttributes(found->at("attributes"), draco);
    primitive.draco = draco;
  }
  return primitive;
}

Mesh toMesh(const json& object) {
  Mesh mesh;
  get(object, "name", mesh.name);
  get(object, "weights", mesh.weights);
  const json& primitives = object.at("primitives");
  mesh.primitives.reserve(primitives.size());
  for (const json& primitive : primitives) {
    mesh.primitives.push_back(primitive.is_null() ? Primitive{} : toPrimitive(primitive));
    mesh.primitives.back().isInvalid = primitive.is_null();
  }
  return mesh;
}

Skin toSkin(const json& object) {
  Skin skin;
  get(object, "joints", skin.joints);
  get(object, "inverseBindMatrices", skin.inverseBindMatrices);
  return skin;
}

Node toNode(const json& object) {
  Node node;
  get(object, "name", node.name);
  get(object, "mesh", node.mesh);
  get(object, "camera", node.camera);
  get(object, "skin", node.skin);
  get(object, "weights", node.weights);
  const json& extensions = child(object, "extensions");
  get(child(extensions, "KHR_lights_punctual"), "light", node.light);
  node.hasInvalidInstancing = isInvalid(extensions, "EXT_mesh_gpu_instancing");
  node.hasInvalidSkin = isInvalid(object, "skin");
  if (extensions.contains("EXT_mesh_gpu_instancing") && !node.hasInvalidInstancing) {
    const json& attributes = extensions.at("EXT_mesh_gpu_instancing").at("attributes");
    GpuInstancing& instancing = node.instancing.emplace();
    get(attributes, "TRANSLATION", instancing.translation);
    get(attributes, "ROTATION", instancing.rotation);
    get(attributes, "SCALE", instancing.scale);
  }
  get(object, "children", node.children);
  get(object, "matrix", node.matrix);
  get(object, "translation", node.translation);
  get(object, "rotation", node.rotation);
  get(object, "scale", node.scale);
  node.hasInvalidChildren = isInvalid(object, "children");
  for (const char* key : {"matrix", "translation", "rotation", "scale"})
    node.hasInvalidTransform = node.hasInvalidTransform || isInvalid(object, key);
  return node;
}

void getTexture(const json& object, const char* key, TextureInfo& texture) {
  const json& info = child(object, key);
  get(info, "index", texture.index);
  get(info, "texCoord", texture.texCoord);
  const json& transform = child(child(info, "extensions"), "KHR_texture_transform");
  get(transform, "offset", texture.offset);
  get(transform, "scale", texture.scale);
  get(transform, "rotation", texture.rotation);
  get(transform, "texCoord", texture.texCoord);
}

Material toMaterial(const json& object) {
  Material material;
  get(object, "name", material.name);
  get(object, "emissiveFactor", material.emissiveFactor);
  get(object, "alphaMode", material.alphaMode);
  get(object, "alphaCutoff", material.alphaCutoff);
  get(object, "doubleSided", material.doubleSided);
  const json& pbr = child(object, "pbrMetallicRoughness");
  get(pbr, "baseColorFactor", material.baseColorFactor);
  getTexture(pbr, "baseColorTexture", material.baseColorTexture);
  getTexture(pbr, "metallicRoughnessTexture", material.metallicRoughnessTexture);
  get(pbr, "metallicFactor", material.metallicFactor);
  get(pbr, "roughnessFactor", material.roughnessFactor);
  const json& extensions = child(object, "extensions");
  get(child(extensions, "KHR_materials_emissive_strength"), "emissiveStrength", material.emissiveStrength);
  get(child(extensions, "KHR_materials_ior"), "ior", material.ior);
  getTexture(object, "emissiveTexture", material.emissiveTexture);
  getTexture(object, "normalTexture", material.normalTexture);
  get(child(object, "normalTexture"), "scale", material.normalScale);
  getTexture(child(extensions, "KHR_materials_transmission"), "transmissionTexture", material.transmissionTexture);
  const json& specular = child(extensions, "KHR_materials_specular");
  get(specular, "specularFactor", material.specularFactor);
  get(specular, "specularColorFactor", material.specularColorFactor);
  const json& clearcoat = child(extensions, "KHR_materials_clearcoat");
  get(clearcoat, "clearcoatFactor", material.clearcoatFactor);
  get(clearcoat, "clearcoatRoughnessFactor", material.clearcoatRoughnessFactor);
  const json& iridescence = child(extensions, "KHR_materials_iridescence");
  get(iridescence, "iridescenceFactor", material.iridescenceFactor);
  get(iridescence, "iridescenceIor", material.iridescenceIor);
  get(iridescence, "iridescenceThicknessMaximum", material.iridescenceThicknessMaximum);
  if (const auto found = extensions.find("KHR_materials_pbrSpecularGlossiness"); found != extensions.end()) {
    SpecularGlossiness& values = material.specularGlossiness.emplace();
    get(*found, "diffuseFactor", values.diffuseFactor);
    get(*found, "specularFactor", values.specularFactor);
    get(*found, "glossinessFactor", values.glossinessFactor);
    getTexture(*found, "diffuseTexture", values.diffuseTexture);
    getTexture(*found, "specularGlossinessTexture", values.specularGlossinessTexture);
  }
  get(child(extensions, "KHR_materials_transmission"), "transmissionFactor", material.transmissionFactor);
  const json& volume = child(extensions, "KHR_materials_volume");
  get(volume, "thicknessFactor", material.volumeThicknessFactor);
  get(volume, "attenuationColor", material.attenuationColor);
  get(volume, "attenuationDistance", material.attenuationDistance);
  return material;
}

Image toImage(const json& object) {
  Image image;
  get(object, "name", image.name);
  get(object, "uri", image.uri);
  get(object, "bufferView", image.bufferView);
  return image;
}

Camera toCamera(const json& object) {
  Camera camera;
  get(object, "name", camera.name);
  get(object, "type", camera.type);
  get(child(object, "perspective"), "yfov", camera.yfov);
  get(child(object, "perspective"), "aspectRatio", camera.aspectRatio);
  get(child(object, "orthographic"), "xmag", camera.xmag);
  get(child(object, "orthographic"), "ymag", camera.ymag);
  return camera;
}

Light toLight(const json& object) {
  Light light;
  get(object, "name", light.name);
  get(object, "type", light.type);
  get(object, "color", light.color);
  get(object, "intensity", light.intensity);
  get(child(object, "spot"), "innerConeAngle", light.innerConeAngle);
  get(child(object, "spot"), "outerConeAngle", light.outerConeAngle);
  return light;
}

Buffer toBuffer(json& object) {
  Buffer buffer;
  if (const auto found = object.find("uri"); found != object.end())
    buffer.uri = std::move(found->get_ref<std::string&>());
  buffer.byteLength = object.at("byteLength").get<std::size_t>();
  return buffer;
}

// Converts lists of the document.
class Lists {
 public:
  Lists(json& document, const std::string& where, GltfLeftOut& leftOut)
      : document_(document), where_(where), leftOut_(leftOut) {}

  // Takes the list at a key out of the document, so that it is freed before the next one is converted.
  json take(const char* key) {
    const auto found = document_.find(key);
    return found == document_.end() ? json::array() : std::move(*found);
  }

  // Appends convert(item, location) for each item, and an invalid one for an item that is null or throws Error.
  template <class Item, class Convert>
  void convert(const char* key, std::vector<Item>& result, Convert convertItem) {
    json list = take(key);
    result.reserve(list.size());
    for (json& item : list) {
      result.emplace_back();
      result.back().isInvalid = true;
      if (item.is_null()) continue;
      try {
        result.back() = convertItem(item, fmt::format("{}: {}[{}]", where_, key, result.size() - 1));
      } catch (const Error& error) {
        leftOut_.addPart(error);
      }
    }
  }

 private:
  json& document_;
  const std::string& where_;
  GltfLeftOut& leftOut_;
};

}  // namespace

Document toDocument(json document, const std::string& where, GltfLeftOut& leftOut) {
  Document result;
  Lists lists(document, where, leftOut);
  get(document, "scene", result.defaultScene);
  for (const json& name : lists.take("extensionsUsed"))
    result.quantized = result.quantized || name == "KHR_mesh_quantization";
  for (const json& scene : lists.take("scenes")) get(scene, "nodes", result.sceneNodes.emplace_back());
  for (const json& node : lists.take("nodes")) result.nodes.push_back(toNode(node));
  lists.convert("meshes", result.meshes, [](const json& mesh, const std::string&) { return toMesh(mesh); });
  for (const json& skin : lists.take("skins")) result.skins.push_back(toSkin(skin));
  lists.convert("accessors", result.accessors, toAccessor);
  lists.convert("bufferViews", result.bufferViews, toBufferView);
  lists.convert("buffers", result.buffers, [](json& buffer, const std::string&) { return toBuffer(buffer); });
  for (const json& material : lists.take("materials")) result.materials.push_back(toMaterial(material));
  for (const json& item : lists.take("textures")) {
    Texture& texture = result.textures.emplace_back();
    get(item, "source", texture.source);
    get(item, "sampler", texture.sampler);
  }
  for (const json& item : lists.take("samplers")) {
    Sampler& sampler = result.samplers.emplace_back();
    get(item, "wrapS", sampler.wrapS);
    get(item, "wrapT", sampler.wrapT);
  }
  for (const json& image : lists.take("images")) result.images.push_back(toImage(image));
  for (const json& camera : lists.take("cameras")) result.cameras.push_back(toCamera(camera));
  const json& punctual = child(child(document, "extensions"), "KHR_lights_punctual");
  if (const auto lights = punctual.find("lights"); lights != punctual.end())
    for (const json& light : *lights) result.lights.push_back(toLight(light));
  return result;
}

}  // namespace malus::prep::gltf
