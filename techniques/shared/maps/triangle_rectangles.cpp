#include "techniques/shared/maps/triangle_rectangles.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

namespace shadowbench::techniques {

void drawTriangleRectangles(const Frame& frame, gl::Program& program) {
    program.use();
    gl::Context& context = gl::Context::current();
    glBindVertexArray(context.noAttributes());
    frame.scene.instances().bindStorage(2);
    for (const gl::SceneBuffers::Batch& batch : frame.scene.batches()) {
        batch.vertices.bindStorage(0);
        batch.indices.bindStorage(1);
        program.set("baseInstance", static_cast<int>(batch.baseInstance));
        glDrawArraysInstanced(GL_TRIANGLES, 0, 6 * batch.triangles, batch.instances);
        ++context.tally().draws;
    }
}

} // namespace shadowbench::techniques
