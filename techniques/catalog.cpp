#include "techniques/entries.h"

#include <array>

namespace shadowbench::techniques {

std::span<const Entry> catalog() {
    static const std::array entries{
        none(),         //
        smUniform(),    //
        smLispsm(),     //
        smHistory(),    //
        volumeZfail(),  //
        pcf(),          //
        pcfPoisson(),   //
        vsm(),          //
        lvsm(),         //
        esm(),          //
        csmFourier(),   //
        deepSm(),       //
        pcss(),         //
        sampledMaps(),  //
        temporalSoft(), //
    };
    return entries;
}

} // namespace shadowbench::techniques
