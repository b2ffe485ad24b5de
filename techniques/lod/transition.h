// The course of a transition between two levels, after Giegl and Wimmer 2007 (dissertation 2.4.3 and Fig. 5.2): the new
// level comes in over the whole of the old one in the first half, the old one goes in the second. No GL.
#pragma once

namespace shadowbench::techniques {

/// How much of each level is seen, in [0, 1]: the opacity of blending, the threshold τ of eq. 5.1. At least one is 1.
struct TransitionVisibility {
    double finer, coarser;
};

/// `progress` from the finer level (0) to the coarser one (1). Reversing the transition swaps the two.
TransitionVisibility transitionVisibility(double progress);

/// What discrete switching shows: the level that is wholly visible (the coarser one in the middle).
bool showsCoarser(double progress);

} // namespace shadowbench::techniques
