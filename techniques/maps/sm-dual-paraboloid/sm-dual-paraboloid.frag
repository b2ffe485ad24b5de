#include "gl/receiver.glsl"
#include "maps/sm-dual-paraboloid/paraboloid.glsl"

uniform sampler2DShadow depthAtlas;
uniform mat4 lightFromWorld;    // the front map's; the back one's is turned by half a turn about y

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    vec3 position = (lightFromWorld * vec4(receiver.position, 1.0)).xyz;
    bool back = position.z < 0.0;
    vec3 at = paraboloid(back ? position * vec3(-1.0, 1.0, -1.0) : position);
    vec2 inTile = 0.5 + 0.5 * at.xy;
    visibility = texture(depthAtlas, vec3(0.5 * inTile.x + (back ? 0.5 : 0.0), inTile.y, at.z));
}
