#include "modern/sat-vsm/moments.frag"
