// What a frame costs on a graphics processor, by that one's own clock and on images as large as screens: on the scored image
// of 256² it costs what it costs to submit.
#pragma once

#include "harness/measure/costs.h"
#include "harness/measure/pass_cost.h"
#include "harness/records/record.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace shadowbench::timing {

/// Whether the context that is current draws on a graphics processor with a clock that can be read.
bool hasDeviceClock();

/// A technique's frames as they are measured. Each call draws one frame.
struct MeasuredFrames {
    RenderFrame standing;                         // G-buffer included
    std::function<void()> base;                   // of what it is compared with
    std::function<void()> forget = {};            // the next frame is the first; empty: there is no such frame
    std::function<void()> leave = {}, stand = {}; // light and casters go elsewhere and return; all is as before. Empty: none
    RenderFrame moved = {};                       // the frame after `leave`
};

/// What is measured on one image.
struct DeviceTimes {
    DeviceCost cost;
    std::vector<double> samples, motionSamples; // ms
    double motionRatio = 1;                     // of the frame in motion to what it is compared with, then
    double compile = 0; // ms of wall time that the first frame of a new technique takes beyond the second
};

/// Fills in the costs of a shadow technique: times are those of the first image, the smaller one.
void setTimes(Record& record, const std::vector<DeviceTimes>& times);

/// Those of a level-of-detail technique, whose times along the walk are measured elsewhere (harness/measure/lod_cost.h).
void setLodTimes(Record& record, const std::vector<DeviceTimes>& times);

/// Pixels on the longer sides of the images that frames are timed on.
using Screens = std::vector<int>;
inline const Screens deviceScreens{1024, 2048};

/// Times frames. While it submits one the graphics processor is busy with other work, so that it need not wait for what
/// follows: as in an application that keeps frames in flight. It waits, and the time says so, where a technique reads back.
/// The same work shows whether the processor's clock is up; frames that find it down are drawn again.
class DeviceMeter {
public:
    DeviceMeter();

    /// Of frames of an image of width × height.
    DeviceTimes measure(const MeasuredFrames& frames, int width, int height);

    /// Of the variant's frames of the scene's `frame`.
    std::vector<DeviceTimes> measure(const Scene& scene, const techniques::Variant& variant, int frame, std::uint32_t seed,
                                     const Screens& screens = deviceScreens);

    /// The same of a level-of-detail technique on frame `frame` of the scene's walk, beside lod-switch.
    std::vector<DeviceTimes> measureLod(const Scene& scene, const techniques::Variant& variant, int frame,
                                        const Screens& screens = deviceScreens);

private:
    class Stamped;

    double busy();
    void raiseClock();
    std::vector<double> samples(int rounds, const std::function<void()>& before, const RenderFrame& render);
    double timePasses(FramePasses& passes, const RenderFrame& render, int rounds);

    gl::Texture texture_;
    gl::RenderTarget target_;
    gl::Program load_;
    bool isDevice_; // else a processor, whose clock is not ours to raise
    int turns_ = 64;
    double fastest_; // ms of the load
};

} // namespace shadowbench::timing
