#include "techniques/gl/counters.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <array>

namespace shadowbench::gl {
namespace {

constexpr std::array<GLenum, 3> statistics{GL_FRAGMENT_SHADER_INVOCATIONS_ARB, GL_VERTICES_SUBMITTED_ARB,
                                           GL_PRIMITIVES_SUBMITTED_ARB};

} // namespace

WorkMeter::WorkMeter() : start_(Context::current().tally()) {
    glGenQueries(3, queries_);
    for (std::size_t i = 0; i < statistics.size(); ++i) glBeginQuery(statistics[i], queries_[i]);
}

WorkMeter::~WorkMeter() {
    if (running_) end();
    glDeleteQueries(3, queries_);
}

void WorkMeter::end() {
    for (const GLenum statistic : statistics) glEndQuery(statistic);
    running_ = false;
}

WorkCount WorkMeter::finish() {
    end();
    Context& context = Context::current();
    context.finish();
    // Mesa's libOSMesa does not export the 64-bit query results by name.
    const auto result = reinterpret_cast<PFNGLGETQUERYOBJECTUI64VPROC>(context.function("glGetQueryObjectui64v"));
    std::array<GLuint64, 3> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) result(queries_[i], GL_QUERY_RESULT, &counts[i]);
    const Tally now = context.tally();
    return {counts[0], counts[1], counts[2], now.draws - start_.draws, now.passes - start_.passes};
}

} // namespace shadowbench::gl
