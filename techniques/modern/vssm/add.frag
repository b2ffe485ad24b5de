#include "modern/sat-vsm/add.frag"
