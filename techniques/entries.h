// The catalogue's lines, one function a technique, each defined in its folder's <id>.cpp.
#pragma once

#include "techniques/technique.h"

namespace shadowbench::techniques {

Entry none();
Entry planarHard();
Entry planarSoft();
Entry planarFake();
Entry smUniform();
Entry smMidpoint();
Entry smFocused();
Entry smPsm();
Entry smLispsm();
Entry smTsm();
Entry smCascaded();
Entry smTiled();
Entry smAdaptive();
Entry smCube();
Entry smDualParaboloid();
Entry smHistory();
Entry smSilhouette();
Entry smAliasFree();
Entry volumeZpass();
Entry volumeZfail();
Entry volumeXor();
Entry pcf();
Entry pcfPoisson();
Entry vsm();
Entry lvsm();
Entry esm();
Entry csmFourier();
Entry deepSm();
Entry pcss();
Entry sampledMaps();
Entry temporalSoft();
Entry lodFull();
Entry lodSwitch();
Entry lodBlend();
Entry lodFrameSequential();

} // namespace shadowbench::techniques
