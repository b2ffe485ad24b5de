#include "techniques/entries.h"

#include <array>

namespace shadowbench::techniques {

std::span<const Entry> catalog() {
    static const std::array entries{
        none(),             //
        planarHard(),       //
        planarSoft(),       //
        planarFake(),       //
        smUniform(),        //
        smMidpoint(),       //
        smFocused(),        //
        smPsm(),            //
        smLispsm(),         //
        smTsm(),            //
        smCascaded(),       //
        smTiled(),          //
        smAdaptive(),       //
        smCube(),           //
        smDualParaboloid(), //
        smHistory(),        //
        smSilhouette(),     //
        smAliasFree(),      //
        volumeZpass(),      //
        volumeZfail(),      //
        volumeXor(),        //
        pcf(),              //
        pcfPoisson(),       //
        vsm(),              //
        lvsm(),             //
        esm(),              //
        csmFourier(),       //
        deepSm(),           //
        pcss(),             //
        sampledMaps(),      //
        temporalSoft(),     //

        lodFull(),            //
        lodSwitch(),          //
        lodBlend(),           //
        lodFrameSequential(), //
    };
    return entries;
}

} // namespace shadowbench::techniques
