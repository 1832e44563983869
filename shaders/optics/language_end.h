// Undoes language_begin.h.
#undef FN
#undef FN_INLINE
#undef CONST
#undef IN
#undef OUT
#undef INOUT
#undef R
