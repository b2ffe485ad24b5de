#include "techniques/gl/counters.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <array>

namespace shadowbench::gl {
namespace {

constexpr std::array<GLenum, 3> statistics{GL_FRAGMENT_SHADER_INVOCATIONS_ARB, GL_VERTICES_SUBMITTED_ARB,
                                           GL_PRIMITIVES_SUBMITTED_ARB};

GLuint64 resultOf(GLuint query) {
    GLuint64 result = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &result);
    return result;
}

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
    const Tally now = context.tally();
    return {resultOf(queries_[0]), resultOf(queries_[1]), resultOf(queries_[2]), now.draws - start_.draws,
            now.passes - start_.passes};
}

FragmentMeter::FragmentMeter() {
    glGenQueries(1, &query_);
    glBeginQuery(GL_SAMPLES_PASSED, query_);
}

FragmentMeter::~FragmentMeter() {
    if (running_) end();
    glDeleteQueries(1, &query_);
}

void FragmentMeter::end() {
    glEndQuery(GL_SAMPLES_PASSED);
    running_ = false;
}

std::uint64_t FragmentMeter::finish() {
    end();
    return resultOf(query_);
}

TimeStamps::~TimeStamps() { glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data()); }

void TimeStamps::mark() {
    glGenQueries(1, &queries_.emplace_back());
    glQueryCounter(queries_.back(), GL_TIMESTAMP);
}

std::vector<double> TimeStamps::intervals() const {
    std::vector<double> result;
    for (std::size_t i = 1; i < queries_.size(); ++i)
        result.push_back(1e-6 * static_cast<double>(resultOf(queries_[i]) - resultOf(queries_[i - 1])));
    return result;
}

bool TimeStamps::isSupported() {
    GLint bits = 0;
    glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    return bits > 0;
}

} // namespace shadowbench::gl
