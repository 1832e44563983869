// Triangles of meshes that are placed by transforms (bake/pack/instances.h), in the frame of the scene.
//
// The acceleration structure transforms rays to the mesh; shading transforms the triangle to the scene. The edges are
// transformed, not the corners, so that a small face keeps its direction wherever it is on its mesh; and the first
// corner is added to the origin, so that what follows computes with numbers of the size of the triangle.
#if MALUS_EFFECT_INSTANCES

struct PlacedTriangle {
  real3 p0, p1, p2;  // corners relative to origin
  real3 origin;      // relative to the scene's
  real3 error;       // bound on what the transform adds to the error of a hit (placementError)
};

FN real3 timesColumns(real3 x, real3 y, real3 z, real3 v) { return x * v.x + y * v.y + z * v.z; }

// origin: of the mesh's record; p0, p1, p2: corners relative to the origin of the mesh. Triangles of meshes without a
// transform do not change.
FN PlacedTriangle placeTriangle(IN(MeshTransform) t, real3 origin, real3 p0, real3 p1, real3 p2) {
  mask isPlaced = notM(equalW(t.kind, kUnplaced));
  real3 corner = timesColumns(t.linearX, t.linearY, t.linearZ, p0) + t.rest;
  real3 e1 = timesColumns(t.linearX, t.linearY, t.linearZ, p1 - p0);
  real3 e2 = timesColumns(t.linearX, t.linearY, t.linearZ, p2 - p0);
  // The sum and its rounding error: Knuth, The Art of Computer Programming, vol. 2, 4.2.2, theorem B.
  PRECISE real3 sum = origin + corner;
  PRECISE real3 added = sum - origin;
  PRECISE real3 kept = sum - added;
  PRECISE real3 lost = (origin - kept) + (corner - added);
  real largest = maxR(largestPart(p0), maxR(largestPart(p1), largestPart(p2)));
  PlacedTriangle placed;
  placed.p0 = select3(isPlaced, lost, p0);
  placed.p1 = select3(isPlaced, lost + e1, p1);
  placed.p2 = select3(isPlaced, lost + e2, p2);
  placed.origin = select3(isPlaced, sum, origin);
  real3 error = placementError(t.spreadX, t.spreadY, t.spreadZ, t.extent, sum, largest, kUnitRoundoff);
  placed.error = select3(isPlaced, error, splat3(R(0.0)));
  return placed;
}

// A normal of the mesh in the frame of the scene, of any length; 0 stays 0.
FN real3 placeNormal(IN(MeshTransform) t, real3 normal) {
  real3 placed = timesColumns(t.normalX, t.normalY, t.normalZ, normal);
  return select3(equalW(t.kind, kUnplaced), normal, placed);
}

#endif
