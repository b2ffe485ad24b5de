// The catalogue's lines, one function a technique, each defined in its folder's <id>.cpp.
#pragma once

#include "techniques/technique.h"

namespace shadowbench::techniques {

Entry none();
Entry smUniform();
Entry smMidpoint();
Entry smFocused();
Entry smPsm();
Entry smLispsm();
Entry smTsm();
Entry smCascaded();
Entry smCube();
Entry smDualParaboloid();
Entry smHistory();
Entry smSilhouette();
Entry smAliasFree();
Entry volumeZfail();
Entry pcf();
Entry pcss();
Entry sampledMaps();
Entry temporalSoft();

} // namespace shadowbench::techniques
