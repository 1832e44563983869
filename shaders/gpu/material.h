// Materials and point lights, in the words of the shared language (shaders/optics/CONVENTIONS.md): a build on another
// number type has the same structs with one value per lane. No include guard.

struct Material {
  real3 eta;       // real part of the index; dielectrics use eta.y in every colour
  real3 k;         // imaginary part: eta - i k
  real3 contrast;  // eta - outsideEta, from double precision
  real3 albedo;    // diffuse reflectance; 0: none. Of an emitter: the radiance of its back
  real3 radiance;  // emitted, by an emitter or the diffuse layer, divided by the square of the index that
                   // it is emitted into. Of glass with a map: its transmittance
  real3 hemisphereTransmittance;  // mean transmittance of the interface for light from all directions
  real outsideEta;                // index on the side that the normals point to
  real basicScale;                // 1 / outsideEta^2: radiance to basic radiance
  real highlightStrength;         // 0: none
  word highlightExponent;         // below 4096
  word kind;                      // SurfaceKind
};

// Properties that only some materials have, one struct per material. Read only by variants whose effects need it.
struct MaterialExtra {
  real3 absorption;         // in 1/m, on the side that the normals point away from
  real3 outsideAbsorption;  // in 1/m, on the side that the normals point to
  real3 axis;               // unit vector, in the scene: of an emitter's field, a polarizer's transmission axis or a
                            // wave plate's fast axis
  real degree;              // degree of linear polarization of an emitter
  real3 transmittanceParallel;  // power transmittance of a polarizing element for light polarized along its axis, of
                                // the inside of thin glass, of the surface of a glass body
  real3 transmittanceCrossed;   // and across it
  real3 retardanceCos;          // of a wave plate
  real3 retardanceSin;
  real3 filmEta;          // index of a thin film; 0: none
  real3 filmOverOutside;  // filmEta - outsideEta and filmEta - eta, from double precision; dielectrics have eta.y
  real3 filmOverBase;     // in place of eta
  real3 roundTripPhase;   // twice its thickness over the wavelength in vacuum
  real outsideResidue;    // outsideEta - its value in Material, and the same of filmEta: for the contrasts of textures
  real3 filmResidue;
  real roughness;   // GGX alpha; 0: smooth
  word albedoMap;   // texture that albedo is multiplied by; kNoTexture: none
  word etaMap;      // texture in place of eta
  word kMap;        // texture in place of k
  real3 mapOrigin;  // texture coordinates: dot(p - mapOrigin, mapU or mapV)
  real3 mapU;
  real3 mapV;
  real specularFactor;  // share of the surface that has the interface, 0 to 1
  real coatShare;       // share of the surface that has a clear coat; 0: none
  real coatEta;         // index of the clear coat
};

// A texture by the texture coordinates of meshes: read at (dot(u, p), dot(v, p)) of p = (s, t, 1), where (s, t) are
// those of a set.
struct TextureMap {
  word texture;  // its first level; the others follow it in textures[]
  word levels;   // at least 1
  word set;      // 0 or 1
  word wrapU;    // pack::Wrap
  word wrapV;
  real3 u;
  real3 v;
};

// Maps of a material, one struct per material: indices into textureMaps, whose first row is unused; 0: none. Read only
// by variants with MALUS_EFFECT_MESH_TEXTURES.
struct MeshMaps {
  word albedo;  // in place of the material's, and so are the others
  word eta;
  word k;
  word reflectance;    // of a metal at normal incidence, in place of eta and k
  word metallic;       // x: edge tint of the reflectance; none: 1
  word roughness;      // x
  word radiance;       // in W/(m^2 sr)
  word transmittance;  // of thin glass, and of the surface of a glass body
  word normal;         // (n + 1) / 2 of the normal n in the frame of tangent, bitangent and normal
  word coverage;       // x: no surface where it is below the cutoff
  real normalScale;    // of the normal's x and y
  real cutoff;
};

// An emitting triangle, or a rectangle, that lights diffuse surfaces. Read only by variants with
// MALUS_EFFECT_AREA_LIGHTS.
struct AreaLight {
  real3 corner;
  real3 edgeU;         // from the corner
  real3 edgeV;         // from the corner; of a rectangle perpendicular to edgeU
  real3 normal;        // unit, on the front
  real3 radiance;      // of the front, as Material.radiance
  real3 backRadiance;  // 0 if the back is dark
  real3 axis;          // of polarized light, as MaterialExtra.axis
  real degree;
  real parallelogram;  // area of the parallelogram of the edges, in m^2
  real isRectangle;    // 1, or 0: a triangle
  real offset;         // distance before the light, in m, at which shadow rays end
};

// A node of the binary tree of the area lights: one light, or a group of them (optics/area_light.h, lightImportance).
struct LightNode {
  real3 centre;
  real radius;
  real3 axis;
  real spread;   // cosine of the angle between the axis and the normals; -1: emits to all sides
  real power;    // sum of radiance times area, over the colours
  real isInner;  // 1: a group
  word index;    // of the light, or of the first of the group's two parts, which the second follows
};

struct PointLight {
  real3 position;
  real3 intensity;  // W/sr
};

// Shape of a spot light or of one at infinity, one struct per light. Read only by variants with
// MALUS_EFFECT_LIGHT_SHAPES.
struct LightShape {
  real3 axis;       // unit vector in which the light travels; 0 of a point light
  real coneScale;   // with the cosine c of the angle from the axis, the intensity is multiplied by
  real coneOffset;  // clamp(c coneScale + coneOffset)^2
  real reach;       // of a light at infinity: a distance beyond all surfaces; 0: the light has a position
};

// Transform of a mesh that has instances, one struct per mesh. Read only by variants with MALUS_EFFECT_INSTANCES. A
// point p of the mesh is at linear p + rest + Mesh.origin.
struct MeshTransform {
  real3 linearX, linearY, linearZ;  // columns
  real3 rest;                       // of the translation, which is Mesh.origin up to its rounding
  real3 normalX, normalY, normalZ;  // columns of a matrix for normals, outward too if the transform mirrors
  real3 spreadX, spreadY, spreadZ;  // columns of |linear| |inverse|, entry by entry: of placementError
  real3 extent;                     // of placementError
  word kind;                        // kUnplaced, kPlaced or kMirrored
};
