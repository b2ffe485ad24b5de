#include "techniques/entries.h"

#include <array>

namespace shadowbench::techniques {

std::span<const Entry> catalog() {
    static const std::array entries{
        none(),             //
        smUniform(),        //
        smMidpoint(),       //
        smFocused(),        //
        smPsm(),            //
        smLispsm(),         //
        smTsm(),            //
        smCascaded(),       //
        smCube(),           //
        smDualParaboloid(), //
        smHistory(),        //
        smSilhouette(),     //
        smAliasFree(),      //
        volumeZfail(),      //
        pcf(),              //
        pcss(),             //
        sampledMaps(),      //
        temporalSoft(),     //
    };
    return entries;
}

} // namespace shadowbench::techniques
