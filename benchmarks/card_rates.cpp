// The rates of the graphics processor at hand, each by a loop of draws that asks for one of its resources and little else:
// what a model of its frames (docs/gpu-cost.md) needs and no data sheet prints for every card. Timed by the processor's own
// clock, the median of nine repeats; prints CSV, a line a rate.
//
//   build/release/benchmarks/card_rates [PIXELS A SIDE]
#include "base/error.h"
#include "harness/measure/rounds.h"
#include "harness/measure/statistics.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"

#include <fmt/format.h>
#include <functional>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

int side = 2048; // of targets
double pixels = 0;

gl::Program screen(const std::string& body, const std::string& outputs = "layout(location = 0) out vec4 result;\n") {
    return gl::Program::screenFromText("rate", outputs + body, {});
}

/// Milliseconds of what `work` submits.
double deviceMilliseconds(const std::function<void()>& work) {
    constexpr int warm = 2, repeats = 9;
    std::vector<double> times;
    for (int i = 0; i < warm + repeats; ++i) {
        gl::Context::current().finish();
        double time = 0;
        if (gl::TimeStamps::isSupported()) {
            gl::TimeStamps stamps;
            stamps.mark();
            work();
            stamps.mark();
            time = stamps.intervals().front();
        } else {
            time = timing::wallMilliseconds(work);
        }
        if (i >= warm) times.push_back(time);
    }
    return timing::median(times);
}

/// `count` of `unit` take `milliseconds`.
void print(const std::string& rate, const std::string& unit, double count, double milliseconds) {
    const gl::ContextInfo& info = gl::Context::current().info();
    fmt::print("\"{}\",\"{}\",\"{}\",{},{},{:.6g},{:.6g}\n", info.renderer, info.version, rate, unit, count, milliseconds,
               1e3 * count / milliseconds);
    std::fflush(stdout);
}

/// Layers that cover a target, nearest last or first.
void fillTargets() {
    const gl::Program constant = screen("void main() { result = vec4(0.25); }\n");
    const std::vector<std::pair<std::string, gl::Format>> formats{
        {"R8", gl::Format::R8},       {"RGBA8", gl::Format::RGBA8},     {"R32F", gl::Format::R32F},
        {"RG32F", gl::Format::RG32F}, {"RGBA16F", gl::Format::RGBA16F}, {"RGBA32F", gl::Format::RGBA32F}};
    constexpr int layers = 8;
    for (const auto& [name, format] : formats) {
        const gl::Texture texture(format, {side, side});
        const gl::RenderTarget target{&texture};
        const auto draw = [&] {
            target.bind();
            for (int i = 0; i < layers; ++i) constant.drawScreen();
        };
        print("write " + name, "pixel", layers * pixels, deviceMilliseconds(draw));
        print("clear " + name, "pixel", layers * pixels, deviceMilliseconds([&] {
                  for (int i = 0; i < layers; ++i) target.clearColour(0, glm::vec4(0.5F));
              }));
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        print("blend " + name, "pixel", layers * pixels, deviceMilliseconds(draw));
        glDisable(GL_BLEND);
    }
}

void fillDepth() {
    const gl::Texture depth(gl::Format::Depth32F, {side, side});
    const gl::RenderTarget target{&depth};
    print("clear Depth32F", "pixel", 8 * pixels, deviceMilliseconds([&] {
              for (int i = 0; i < 8; ++i) target.clearDepth(1);
          }));
    const gl::Program shaded = screen("void main() { gl_FragDepth = 0.5; }\n", "");
    print("write Depth32F by the shader", "pixel", 8 * pixels, deviceMilliseconds([&] {
              target.bind();
              for (int i = 0; i < 8; ++i) shaded.drawScreenDepth();
          }));
}

/// Multiply-adds of four chains, and special functions of one.
void doArithmetic() {
    const gl::Texture texture(gl::Format::R32F, {side, side});
    const gl::RenderTarget target{&texture};
    constexpr int turns = 256;
    const auto time = [&](const std::string& step) {
        gl::Program program = screen("uniform int turns;\nvoid main() {\n  vec4 v = gl_FragCoord.xyzw;\n"
                                     "  for (int i = 0; i < turns; ++i) {" +
                                     step + "}\n  result = v;\n}\n");
        program.set("turns", turns);
        return deviceMilliseconds([&] {
            target.bind();
            program.drawScreen();
        });
    };
    print("multiply-add, 4 chains", "operation", 16 * turns * pixels,
          time("v = v * 0.999 + 0.001; v = v * 0.998 + 0.002; v = v * 0.997 + 0.003; v = v * 0.996 + 0.004;"));
    print(
        "multiply-add, 1 chain", "operation", 4 * turns * pixels,
        time("v.x = v.x * 0.999 + 0.001; v.x = v.x * 0.998 + 0.002; v.x = v.x * 0.997 + 0.003; v.x = v.x * 0.996 + 0.004;"));
    print("exp2", "operation", 4 * turns * pixels, time("v = exp2(-v);"));
    print("inverse square root", "operation", 4 * turns * pixels, time("v = inversesqrt(v + 1.0);"));
    print("integer", "operation", 8 * turns * pixels,
          time("ivec4 u = floatBitsToInt(v); u = (u ^ 1234567) + (u >> 3); v = intBitsToFloat(u);"));
}

/// Reads of a texture, side by side, or far from the neighbour's.
void readTextures() {
    const gl::Texture texture(gl::Format::RGBA32F, {side, side});
    const gl::RenderTarget target{&texture};
    constexpr int taps = 32;
    struct Case {
        std::string name;
        gl::Format format;
        gl::Filter filter;
        bool compared;
        int mapSide;
        bool scattered;
    };
    std::vector<Case> cases;
    for (const bool scattered : {false, true})
        for (const int mapSide : {512, 1024, 4096}) {
            const std::string where = fmt::format(" of {}²{}", mapSide, scattered ? ", scattered" : "");
            cases.push_back({"nearest R32F" + where, gl::Format::R32F, gl::Filter::Nearest, false, mapSide, scattered});
            cases.push_back({"linear R32F" + where, gl::Format::R32F, gl::Filter::Linear, false, mapSide, scattered});
            cases.push_back({"linear RG32F" + where, gl::Format::RG32F, gl::Filter::Linear, false, mapSide, scattered});
            cases.push_back({"linear RGBA8" + where, gl::Format::RGBA8, gl::Filter::Linear, false, mapSide, scattered});
            cases.push_back(
                {"nearest RGBA32F" + where, gl::Format::RGBA32F, gl::Filter::Nearest, false, mapSide, scattered});
            cases.push_back(
                {"nearest Depth32F" + where, gl::Format::Depth32F, gl::Filter::Nearest, false, mapSide, scattered});
            cases.push_back(
                {"compared Depth32F" + where, gl::Format::Depth32F, gl::Filter::Linear, true, mapSide, scattered});
        }
    for (const Case& c : cases) {
        gl::Texture map(c.format, {c.mapSide, c.mapSide}, c.filter);
        if (c.compared) map.compareDepth();
        const gl::RenderTarget mapTarget{&map};
        if (c.format == gl::Format::Depth32F)
            mapTarget.clearDepth(0.5F);
        else
            mapTarget.clearColour(0, glm::vec4(0.5F));
        const std::string place = c.scattered
                                      ? "vec2 p = fract(vec2(7.13, 3.77) * gl_FragCoord.xy + vec2(0.618, 0.381) * float(i));"
                                      : fmt::format("vec2 p = (gl_FragCoord.xy + vec2(i % 6, i / 6)) / {}.0;", side);
        gl::Program program = screen(
            std::string("uniform ") + (c.compared ? "sampler2DShadow" : "sampler2D") +
            " map;\nuniform int taps;\nvoid main() {\n  vec4 sum = vec4(0);\n  for (int i = 0; i < taps; ++i) {" + place +
            (c.compared ? "sum.x += textureLod(map, vec3(p, 0.4), 0.0);" : "sum += textureLod(map, p, 0.0);") +
            "}\n  result = sum;\n}\n");
        program.set("map", map).set("taps", taps);
        print(c.name, "read", taps * pixels, deviceMilliseconds([&] {
                  target.bind();
                  program.set("map", map);
                  program.drawScreen();
              }));
    }
}

/// Reads of a storage buffer and atomic additions to one: all lanes at one place, each beside its neighbour's, or scattered.
void useBuffers() {
    const gl::Texture texture(gl::Format::RGBA32F, {side, side});
    const gl::RenderTarget target{&texture};
    constexpr int taps = 32, words = 1 << 22;
    const std::vector<std::pair<std::string, std::string>> places{
        {"one place for all", "uint(i)"},
        {"side by side", "uint(gl_FragCoord.y) * 2048u + uint(gl_FragCoord.x) + uint(i)"},
        {"scattered", "uint(gl_FragCoord.x) * 2654435761u ^ uint(gl_FragCoord.y) * 2246822519u ^ uint(i) * 3266489917u"}};
    const auto time = [&](const std::string& type, int count, const std::string& place, const std::string& use) {
        gl::Buffer buffer;
        buffer.clear(std::size_t{words} * 4);
        gl::Program program =
            screen(fmt::format("layout(std430, binding = 0) buffer Words {{ {} words[]; }};\nuniform int taps;\nvoid main() "
                               "{{\n  {} sum = {}(0);\n"
                               "  for (int i = 0; i < taps; ++i) {{ uint p = ({}) % {}u; {} }}\n  result = vec4(sum);\n}}\n",
                               type, type, type, place, count, use));
        program.set("taps", taps);
        return deviceMilliseconds([&] {
            buffer.bindStorage(0);
            target.bind();
            program.drawScreen();
        });
    };
    for (const auto& [name, place] : places) {
        print("buffer reads of 4 bytes, " + name, "read", taps * pixels, time("float", words, place, "sum += words[p];"));
        print("buffer reads of 16 bytes, " + name, "read", taps * pixels,
              time("vec4", words / 4, place, "sum += words[p];"));
        print("atomic additions, " + name, "addition", taps * pixels,
              time("uint", words, place, "atomicAdd(words[p], 1u);"));
    }
}

GLuint compiled(GLenum stage, const std::string& body) {
    const GLuint shader = glCreateShader(stage);
    const std::string text = "#version 450 core\n" + body;
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == 0) throw InternalError("a shader of card_rates does not compile:\n" + text);
    return shader;
}

/// Draws triangles whose corners `place` puts, from `triangle` and `corner`, into `target`; nothing but depth is written.
void drawTriangles(const std::string& rate, const std::string& unit, double perTriangle, int count, const std::string& place,
                   const gl::RenderTarget& target, bool depthTest) {
    const GLuint program = glCreateProgram();
    glAttachShader(
        program, compiled(GL_VERTEX_SHADER, "void main() {\n  int triangle = gl_VertexID / 3, corner = gl_VertexID % 3;\n  "
                                            "vec2 unit = vec2(corner == 1, corner == 2);\n" +
                                                place + "}\n"));
    glAttachShader(program, compiled(GL_FRAGMENT_SHADER, "void main() {}\n"));
    glLinkProgram(program);
    if (depthTest) glEnable(GL_DEPTH_TEST);
    const double time = deviceMilliseconds([&] {
        target.clearDepth(1);
        target.bind();
        glUseProgram(program);
        glBindVertexArray(gl::Context::current().noAttributes());
        glDrawArrays(GL_TRIANGLES, 0, 3 * count);
    });
    glDisable(GL_DEPTH_TEST);
    print(rate, unit, perTriangle * count, time);
}

void setUpTriangles() {
    const gl::Texture depth(gl::Format::Depth32F, {side, side});
    const gl::RenderTarget target{&depth};
    const std::string grid = "  vec2 at = vec2(triangle % 1024, triangle / 1024) / 512.0 - 1.0;\n";
    drawTriangles("triangles outside", "triangle", 1, 1 << 20, "  gl_Position = vec4(unit + 2.0, 0.5, 1.0);\n", target,
                  false);
    drawTriangles("triangles of half a pixel", "triangle", 1, 1 << 20,
                  grid + "  gl_Position = vec4(at + unit / 1024.0, 0.5, 1.0);\n", target, true);
    drawTriangles("triangles of eight pixels", "triangle", 1, 1 << 20,
                  grid + "  gl_Position = vec4(at + unit / 256.0, 0.5 - float(triangle) / 4194304.0, 1.0);\n", target, true);
    drawTriangles("depth written, layer over layer", "pixel", pixels, 32,
                  "  gl_Position = vec4(4.0 * unit - 1.0, 0.5 - float(triangle) / 128.0, 1.0);\n", target, true);
    drawTriangles("depth rejected, layer under layer", "pixel", pixels, 32,
                  "  gl_Position = vec4(4.0 * unit - 1.0, 0.5 + float(triangle) / 128.0, 1.0);\n", target, true);
}

/// What a draw, a pass and a change of program cost, and a pass that reads what the one before wrote.
void submit() {
    constexpr int count = 1000;
    const gl::Texture a(gl::Format::RGBA8, {16, 16}), b(gl::Format::RGBA8, {16, 16});
    const gl::RenderTarget intoA{&a}, intoB{&b};
    gl::Program constant = screen("void main() { result = vec4(0.25); }\n");
    gl::Program other = screen("void main() { result = vec4(0.75); }\n");
    gl::Program reader =
        screen("uniform sampler2D map;\nvoid main() { result = texelFetch(map, ivec2(gl_FragCoord.xy), 0); }\n");
    print("draws", "draw", count, deviceMilliseconds([&] {
              intoA.bind();
              for (int i = 0; i < count; ++i) constant.drawScreen();
          }));
    print("draws that change the program", "draw", count, deviceMilliseconds([&] {
              intoA.bind();
              for (int i = 0; i < count; ++i) (i % 2 == 0 ? constant : other).drawScreen();
          }));
    print("passes", "pass", count, deviceMilliseconds([&] {
              for (int i = 0; i < count; ++i) {
                  (i % 2 == 0 ? intoA : intoB).bind();
                  constant.drawScreen();
              }
          }));
    print("passes that read the one before", "pass", count, deviceMilliseconds([&] {
              for (int i = 0; i < count; ++i) {
                  (i % 2 == 0 ? intoA : intoB).bind();
                  reader.set("map", i % 2 == 0 ? b : a);
                  reader.drawScreen();
              }
          }));
    print("read back of 16²", "read back", 1, timing::median([&] {
              std::vector<double> times;
              for (int i = 0; i < 20; ++i) times.push_back(timing::wallMilliseconds([&] { (void)intoA.readVec4(0); }));
              return times;
          }()));
    const gl::Texture large(gl::Format::R32F, {1024, 1024});
    const gl::RenderTarget intoLarge{&large};
    print("read back of 1024² R32F", "read back", 1, timing::median([&] {
              std::vector<double> times;
              for (int i = 0; i < 20; ++i) times.push_back(timing::wallMilliseconds([&] { (void)intoLarge.readFloat(0); }));
              return times;
          }()));
}

void measure() {
    const auto context = gl::Context::create();
    fmt::print("renderer,version,rate,unit,count,milliseconds,per_second\n");
    submit();
    fillTargets();
    fillDepth();
    setUpTriangles();
    doArithmetic();
    readTextures();
    useBuffers();
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    try {
        if (argc > 1) shadowbench::side = std::stoi(argv[1]);
        shadowbench::pixels = double(shadowbench::side) * shadowbench::side;
        shadowbench::measure();
        return 0;
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "card_rates: {}\n", error.what());
        return static_cast<int>(error.code());
    }
}
