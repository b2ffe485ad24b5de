// The object library that a precompiled header belongs to needs a source.
