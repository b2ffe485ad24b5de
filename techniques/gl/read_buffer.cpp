#include "techniques/gl/read_buffer.h"

#include "techniques/gl/api.h"

namespace shadowbench::gl {

std::vector<std::uint32_t> readWords(const Buffer& buffer, std::size_t count) {
    std::vector<std::uint32_t> words(count);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer.id());
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(std::uint32_t)), words.data());
    return words;
}

} // namespace shadowbench::gl
