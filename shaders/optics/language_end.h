// Undoes language_begin.h.
#undef FN
#undef CONST
#undef IN
#undef OUT
#undef INOUT
#undef R
