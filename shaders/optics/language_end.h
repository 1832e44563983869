// Undoes language_begin.h.
#undef FN
#undef CONST
#undef OUT
#undef INOUT
#undef R
