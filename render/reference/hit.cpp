#include "render/reference/hit.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "bake/pack/instances.h"
#include "shaders/gpu/constants.h"

namespace malus::reference {

namespace {

double largest(double a, double b, double c) { return f64::maxR(a, f64::maxR(b, c)); }

Face computeFace(const dvec3& p0, const dvec3& p1, const dvec3& p2) {
  const dvec3 e1 = p1 - p0, e2 = p2 - p0, across = glm::cross(e1, e2);
  const double area2 = glm::length(across);
  // 1.75 > sqrt(3)
  return {area2 > 0 ? across / area2 : dvec3(0), area2,
          1.75 * largest(f64::largestPart(e1), f64::largestPart(e2), f64::largestPart(p2 - p1))};
}

}  // namespace

std::vector<Face> computeFaces(const pack::Mesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles)
    faces.push_back(computeFace(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]));
  return faces;
}

namespace {

// The triangle that was found, in the scene.
struct Triangle {
  dvec3 p0, p1, p2;
  glm::uvec3 corners;
  Face face;
  double b1, b2;
  dvec3 origin, placedError;
};

// A unit normal of a mesh at a place; null: its first one.
dvec3 placeNormal(const pack::Instance* place, const dvec3& n) {
  if (place == nullptr) return n;
  return glm::normalize(pack::cofactors(place->linear) * n) * (pack::isMirrored(place->linear) ? -1.0 : 1.0);
}

f64::TexturePoint texturePointAt(const pack::Mesh& mesh, std::uint32_t vertex) {
  const auto set = [&](std::size_t k) {
    return mesh.textureCoordinates[k].empty() ? glm::dvec2(0) : glm::dvec2(mesh.textureCoordinates[k][vertex]);
  };
  const glm::dvec2 first = set(0), second = set(1);
  return {first.x, first.y, second.x, second.y};
}

// The normal of the material's normal map. normal: unit, from outside; t: the triangle's vertices.
dvec3 mappedNormalAt(const MeshTextures& textures, const pack::MeshMaps& maps, const pack::Mesh& mesh,
                     const Triangle& triangle, const pack::Instance* place, const dvec3& barycentric,
                     const dvec3& normal, const f64::TextureHit& at) {
  const glm::uvec3& t = triangle.corners;
  dvec3 tangent(0);
  double handedness = 1;
  if (!mesh.tangents.empty()) {
    const glm::dvec4 sum = glm::dvec4(mesh.tangents[t.x]) * barycentric.x +
                           glm::dvec4(mesh.tangents[t.y]) * barycentric.y +
                           glm::dvec4(mesh.tangents[t.z]) * barycentric.z;
    tangent = dvec3(sum);
    handedness = sum.w < 0 ? -1 : 1;
    if (place != nullptr) {
      tangent = place->linear * tangent;
      if (pack::isMirrored(place->linear)) handedness = -handedness;
    }
  }
  if (tangent == dvec3(0)) {
    const auto& set = mesh.textureCoordinates[maps.normal.set];
    if (set.empty()) return normal;
    const glm::dvec2 first = set[t.x], edge1 = glm::dvec2(set[t.y]) - first, edge2 = glm::dvec2(set[t.z]) - first;
    const f64::TriangleTangent derived =
        f64::triangleTangent(triangle.p1 - triangle.p0, triangle.p2 - triangle.p0, edge1.x, edge1.y, edge2.x, edge2.y);
    tangent = derived.tangent;
    handedness = derived.determinant < 0 ? 1 : -1;
  }
  const dvec3 n = textures.at(maps.normal, at) * 2.0 - 1.0;
  const dvec3 mapped =
      f64::mappedNormal(normal, tangent, handedness, n.x * maps.normalScale, n.y * maps.normalScale, n.z);
  return glm::dot(mapped, mapped) > 1e-12 ? mapped : normal;
}

// Cone and texture coordinates at the hit's position.
f64::TextureHit findTextureHit(const SceneAccess& access, const pack::Mesh& mesh, const Triangle& triangle,
                               const pack::Instance* place, const Ray& ray, double b1, double b2, Hit& hit) {
  const glm::uvec3& t = triangle.corners;
  const dvec3 &p0 = triangle.p0, &p1 = triangle.p1, &p2 = triangle.p2;
  const f64::RayCone cone = f64::coneAfter(f64::coneOfPath(ray.path, access.cone.width, access.cone.spread),
                                           glm::length(hit.position - ray.origin));
  hit.path = f64::pathWithCone(ray.path, cone);
  if (!mesh.normals.empty())
    hit.curvature =
        f64::triangleCurvature(p0, p1, p2, placeNormal(place, mesh.normals[t.x]), placeNormal(place, mesh.normals[t.y]),
                               placeNormal(place, mesh.normals[t.z]));
  return f64::textureHitOfTriangle(ray.d, p1 - p0, p2 - p0, b1, b2, cone.width, texturePointAt(mesh, t.x),
                                   texturePointAt(mesh, t.y), texturePointAt(mesh, t.z));
}

Triangle findTriangle(const SceneAccess& access, const pack::Mesh& mesh, const embree::Intersection& found) {
  const std::uint32_t source = access.records.meshes[found.mesh];
  const gpu::MeshTransform& transform = access.records.transforms[found.mesh];
  const glm::uvec3 t = mesh.triangles[found.triangle];
  Triangle result{mesh.positions[t.x],
                  mesh.positions[t.y],
                  mesh.positions[t.z],
                  t,
                  access.faces[source][found.triangle],
                  found.b1,
                  found.b2,
                  mesh.origin,
                  dvec3(0)};
  if (transform.kind == gpu::kUnplaced) return result;

  // The queries are in single precision.
  const dvec3 local0 = result.p0 - mesh.origin, local1 = result.p1 - mesh.origin, local2 = result.p2 - mesh.origin;
  const double extent = largest(f64::largestPart(local0), f64::largestPart(local1), f64::largestPart(local2));
  const std::uint32_t instance = access.records.instances[found.mesh];
  if (instance != render::kNoInstance) {
    const pack::Instance& place = access.scene.instances[instance];
    for (dvec3* p : {&result.p0, &result.p1, &result.p2, &result.origin}) *p = pack::placedPoint(place, *p);
    if (transform.kind == gpu::kMirrored) {
      std::swap(result.p1, result.p2);
      std::swap(result.b1, result.b2);
      std::swap(result.corners.y, result.corners.z);
    }
    result.face = computeFace(result.p0, result.p1, result.p2);
  }
  result.placedError = f64::placementError(dvec3(transform.spreadX), dvec3(transform.spreadY), dvec3(transform.spreadZ),
                                           dvec3(transform.extent), result.p0, extent, 0x1p-24);
  return result;
}

}  // namespace

void findHit(const SceneAccess& access, const Ray& ray, const embree::Intersection& found, Hit& hit) {
  const pack::Mesh& mesh = access.scene.meshes[access.records.meshes[found.mesh]];
  const Triangle triangle = findTriangle(access, mesh, found);
  const std::uint32_t instance = access.records.instances[found.mesh];
  const pack::Instance* const place = instance == render::kNoInstance ? nullptr : &access.scene.instances[instance];
  const Face& face = triangle.face;
  const glm::uvec3& t = triangle.corners;
  const dvec3 &p0 = triangle.p0, &p1 = triangle.p1, &p2 = triangle.p2, &d = ray.d;
  const dvec3 e1 = p1 - p0, e2 = p2 - p0;
  const double area2 = face.area2;
  hit.d = d;
  hit.materialIndex = mesh.material;
  hit.face = area2 > 0 ? face.normal : -d;

  // Intersect the ray with the plane of the triangle; barycentric coordinates from signed areas.
  double b1 = triangle.b1, b2 = triangle.b2;
  const double slope = glm::dot(d, hit.face);
  if (area2 > 0 && slope != 0) {
    const dvec3 q = ray.origin + d * (glm::dot(p0 - ray.origin, hit.face) / slope);
    const double u = glm::dot(glm::cross(p0 - p2, q - p2), hit.face) / area2;
    const double v = glm::dot(glm::cross(e1, q - p0), hit.face) / area2;
    // At grazing incidence the single-precision hit is more accurate.
    if (std::abs(u - b1) < 1e-2 && std::abs(v - b2) < 1e-2) b1 = u, b2 = v;
  }
  const double b0 = 1 - b1 - b2;
  hit.position = f64::trianglePoint(p0, e1, e2, b1, b2);
  hit.path = ray.path;
  hit.curvature = 0;
  f64::TextureHit textureHit = f64::noTextureHit();
  if (access.textures != nullptr) textureHit = findTextureHit(access, mesh, triangle, place, ray, b1, b2, hit);
  hit.surface = surfaceAt(access.surfaces[mesh.material], access.scene, access.textures, hit.position, textureHit);
  // The next query is in single precision.
  const dvec3& o = triangle.origin;
  hit.error = f64::hitPointError(p0 - o, e1, e2, b1, b2, 0x1p-24) + f64::originError(o, 0x1p-24) +
              f64::intersectionError(p0, p1, p2, hit.position, 0x1p-24) + triangle.placedError;
  const double margin = 4 * f64::largestPart(hit.error);
  // The nearest edge is at least the least coordinate times area2 over the longest edge away.
  hit.start = f64::minR(b0, f64::minR(b1, b2)) * area2 > margin * face.longest
                  ? hit.position
                  : f64::insideTriangle(hit.position, p0, p1, p2, b0, b1, b2, glm::cross(e1, e2), margin);
  hit.outside = slope < 0;
  dvec3 interpolated = hit.face;
  if (!mesh.normals.empty()) {
    const dvec3 n = dvec3(mesh.normals[t.x]) * b0 + dvec3(mesh.normals[t.y]) * b1 + dvec3(mesh.normals[t.z]) * b2;
    if (glm::dot(n, n) > 0) interpolated = placeNormal(place, n);
  }
  const pack::MeshMaps& maps = hit.surface.material->meshMaps;
  if (maps.normal.isUsed())
    interpolated = mappedNormalAt(*access.textures, maps, mesh, triangle, place, {b0, b1, b2},
                                  glm::normalize(interpolated), textureHit);
  hit.normal = f64::shadingNormal(d, hit.face, interpolated);
  if (!hit.outside) hit.face = -hit.face, hit.curvature = -hit.curvature;
  hit.c = f64::clampUnit(-glm::dot(d, hit.normal));
  hit.above = f64::rayOrigin(hit.start, hit.error, hit.face, 0x1p-24);
}

std::uint32_t reflectedPath(const SceneAccess& access, const Hit& h) {
  const std::uint32_t path = f64::reflectedPath(h.path);
  if (access.textures == nullptr) return path;
  return f64::pathWithCone(path, f64::reflectedCone(f64::coneOfBits(h.path), h.curvature, h.c));
}

std::uint32_t facetPath(const SceneAccess& access, const Hit& h, std::uint32_t facet) {
  const std::uint32_t path = f64::facetPath(h.path, facet);
  if (access.textures == nullptr) return path;
  f64::RayCone cone = f64::reflectedCone(f64::coneOfBits(h.path), h.curvature, h.c);
  cone.spread += 0.5 * h.surface.roughness;
  return f64::pathWithCone(path, cone);
}

Hit environmentHit(const dvec3& d) {
  Hit h{};
  h.d = d;
  h.materialIndex = gpu::kEnvironment;
  return h;
}

Refraction refractionAt(Hit& h) {
  const pack::Material& m = *h.surface.material;
  const bool isBody = pack::hasInside(m.kind), entersOutside = isBody && !h.outside;
  const double inside = h.surface.eta.y;
  Refraction r{entersOutside ? inside : m.outsideEta, entersOutside ? m.outsideEta : inside, h.d, false};
  const auto refract = [&] {
    const f64::RefractionTerms terms = f64::refractionTerms(h.c, r.n1, r.n2);
    r.direction = f64::refractedDirectionFromTerms(h.d, h.normal, h.c, terms);
    r.isTotal = terms.total;
  };
  if (!isBody) return r;
  refract();
  if (!r.isTotal && glm::dot(r.direction, h.face) >= 0) {
    h.normal = h.face;
    h.c = f64::clampUnit(-glm::dot(h.d, h.face));
    refract();
  }
  return r;
}

}  // namespace malus::reference
