// Pixel of an invocation within the region. lavapipe runs 8 consecutive invocations of a row on the lanes of a SIMD
// register: they render 4 x 2 pixels, whose rays are more alike than those of 8 x 1.
uvec2 launchPixel() {
  uvec2 id = gl_LaunchIDEXT.xy;
  uvec2 block = id & ~uvec2(7u, 1u);
  if (block.x + 8u > gl_LaunchSizeEXT.x || block.y + 2u > gl_LaunchSizeEXT.y) return id;
  return block + uvec2((id.x & 3u) + 4u * (id.y & 1u), id.x >> 2u & 1u);
}
