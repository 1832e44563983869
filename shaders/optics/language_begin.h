// Words of the shared language for C++; shaders/gpu/language.glsl has them for GLSL. Included before shared files and
// undone by language_end.h. The including namespace defines the types real, real2, real3, mask and word (optics.h).
#define FN static inline                     // a function
#define FN_INLINE [[gnu::always_inline]] FN  // a function that is worth inlining at every call
#define FN_TERMS FN                          // of an interface: inlined by drivers that may use a part of its result
#define CONST static constexpr               // a constant
#define CONST_REAL(name, value) CONST real name = static_cast<real>(value)
#define PRECISE                            // variable whose sums no compiler may reorder
#define IN(T) const T&                     // a large parameter that is read
#define OUT(T) T&                          // a parameter that is written
#define INOUT(T) T&                        // a parameter that is read and written
#define R(x) static_cast<real>(x)          // a literal
#define SELECT(m, a, b) ((m) ? (a) : (b))  // of two structs; a and b may both be evaluated
