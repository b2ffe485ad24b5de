// Combination of the newer and the older LOD buffer (dissertation 5.1.4, listing 6.3).
// REPROJECT 0: the older buffer is read at the same pixel; 1: where the camera saw the point (eq. 5.2); 2: and where the point's
// instance was.
uniform sampler2D newColour;  // alpha: which instance in transition, or 0
uniform sampler2D newDepth;
uniform sampler2D oldColour;
uniform sampler2D oldDepth;

#if REPROJECT > 0
uniform mat4 oldFromNew;  // clip space
#endif
#if REPROJECT == 2
layout(std430, binding = 0) readonly buffer Motions { mat4 oldFromNewOf[]; };  // by id
uniform int motions;
#endif

layout(location = 0) out vec4 colour;

void main() {
    vec2 at = gl_FragCoord.xy / vec2(textureSize(newColour, 0)), oldAt = at;
    vec4 newer = texture(newColour, at);
    colour = newer;

    float depth = texture(newDepth, at).r;  // in the window, as the older camera counts it
#if REPROJECT > 0
    vec4 clip = vec4(2.0 * vec3(at, depth) - 1.0, 1.0);
#if REPROJECT == 2
    int id = int(round(255.0 * newer.a));
    mat4 toOld = id != 0 && id < motions ? oldFromNewOf[id] : oldFromNew;
#else
    mat4 toOld = oldFromNew;
#endif
    vec4 old = toOld * clip;
    if (old.w <= 0.0 || any(greaterThanEqual(abs(old.xy), vec2(old.w)))) return;  // outside the older buffer
    oldAt = 0.5 * old.xy / old.w + 0.5;
    depth = 0.5 * old.z / old.w + 0.5;
#endif
    vec4 older = texture(oldColour, oldAt);

    if (newer.a == 0.0 && older.a == 0.0) return;              // neither is in transition
    if (newer.a == older.a) colour = 0.5 * (newer + older);    // two levels of one instance
    else if (texture(oldDepth, oldAt).r < depth) colour = older;  // the nearer one
}
