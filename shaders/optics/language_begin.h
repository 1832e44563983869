// The words that the shared files are written in, for C++. GLSL gets the same words from
// shaders/gpu/language.glsl. Included before shared files and undone by language_end.h; the including
// namespace defines the types real, real2, real3 and mask (see optics.h).
#define FN static inline                     // a function
#define FN_INLINE [[gnu::always_inline]] FN  // a function that is worth inlining at every call
#define CONST static constexpr               // a constant
#define IN(T) const T&                       // a large parameter that is read
#define OUT(T) T&                            // a parameter that is written
#define INOUT(T) T&                          // a parameter that is read and written
#define R(x) static_cast<real>(x)            // a literal
