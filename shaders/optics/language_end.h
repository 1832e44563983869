// Undoes language_begin.h.
#undef FN
#undef FN_INLINE
#undef FN_TERMS
#undef CONST
#undef CONST_REAL
#undef PRECISE
#undef IN
#undef OUT
#undef INOUT
#undef R
#undef SELECT
