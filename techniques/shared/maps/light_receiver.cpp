#include "techniques/shared/maps/light_receiver.h"

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

void setLightReceiver(gl::Program& program, const LightView& view, bool followPlane) {
    program.set("mapFromWorld", mapFromWorld(view))
        .set("depthFromWorld", glm::vec4(view.depthFromWorld))
        .set("followPlane", followPlane ? 1.0F : 0.0F);
}

} // namespace shadowbench::techniques
