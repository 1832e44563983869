// The word that rays carry on their way down, beside their depth: numbers that differ between pixels and paths, but not
// between methods, number types and renderers, so that the differences between images are free of noise. Integer
// arithmetic alone, modulo 2^32.
//
//   bits 31 to 16  hash of the pixel, of the sample within it and of the path. Bit 30 is 0 and bit 29 is 1: as the bits
//                  of a float the word is a normal number, which payloads keep.
//   bits 15 to 0   state of the ray's footprint; passed on unchanged here

// Mixes all bits of a word. Source: C. Wellons, Hash Function Prospector (2018), `lowbias32`.
FN word mixWord(word x) {
  x = timesW(xorW(x, shiftRightW(x, 16)), 0x7feb352du);
  x = timesW(xorW(x, shiftRightW(x, 15)), 0x846ca68bu);
  return xorW(x, shiftRightW(x, 16));
}

// A path word with a hash of 14 bits of `mixed` and the lower half of `low`.
FN word makePathWord(word low, word mixed) { return joinWord(low, orW(andW(highHalf(mixed), 0x9fffu), 0x2000u)); }

// Path word of the camera's ray through a sample of the image. column, row: of the samples of all pixels, below 2^24.
FN word pathStart(word column, word row) { return makePathWord(0u, mixWord(addW(column, mixWord(addW(row, 1u))))); }

// Path words of the rays that leave a surface. index: of the facet.
FN word pathAfter(word path, word interaction) {
  return makePathWord(path, mixWord(addW(highHalf(path), timesW(interaction, 65536u))));
}
FN word reflectedPath(word path) { return pathAfter(path, 1u); }
FN word transmittedPath(word path) { return pathAfter(path, 2u); }
FN word facetPath(word path, word index) { return pathAfter(path, addW(index, 3u)); }

// Two numbers in [0, 1), in steps of 2^-16, of a path and a purpose, which rotate a fixed set of samples.
FN void pathRotation(word path, word purpose, OUT(real) u, OUT(real) v) {
  word mixed = mixWord(addW(highHalf(path), timesW(purpose, 65536u)));
  u = realOfWord(lowHalf(mixed)) * R(1.52587890625e-5);
  v = realOfWord(highHalf(mixed)) * R(1.52587890625e-5);
}
