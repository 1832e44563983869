// The words of the shared files, for GLSL (the C++ side is shaders/optics/language_begin.h).
// MALUS_DOUBLE is set by the test that runs the optics in double.
#ifdef MALUS_DOUBLE
#define real double
#define real2 dvec2
#define real3 dvec3
#define R(x) double(x)
#else
#define real float
#define real2 vec2
#define real3 vec3
#define R(x) float(x)
#endif
#define mask bool
#define word uint
#define FN
#define FN_INLINE
#define FN_TERMS
#define SELECT(m, a, b) ((m) ? (a) : (b))
#define CONST const
#define CONST_REAL(name, value) const real name = R(value)
#define PRECISE precise
#define IN(T) T
#define OUT(T) out T
#define INOUT(T) inout T
