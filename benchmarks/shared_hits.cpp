#include "benchmarks/shared_hits.h"

#include "base/error.h"

#include <sys/mman.h>

namespace shadowbench::benchmarks {
namespace {

std::size_t pixelCount(int size) { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }

} // namespace

SharedHits::SharedHits(int size) : size_(size) {
    void* memory =
        mmap(nullptr, pixelCount(size) * sizeof(Pixel), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw InternalError("There is no memory to share primary hits in.");
    pixels_ = static_cast<Pixel*>(memory);
}

SharedHits::~SharedHits() { munmap(pixels_, pixelCount(size_) * sizeof(Pixel)); }

void SharedHits::store(const groundtruth::PrimaryHits& hits) const {
    for (std::size_t i = 0; i < hits.id.size(); ++i)
        pixels_[i] = {hits.id[i], hits.triangle[i], hits.position[i], hits.surface[i]};
}

groundtruth::PrimaryHits SharedHits::load() const {
    groundtruth::PrimaryHits hits{Image<std::uint32_t>(size_, size_), Image<glm::vec3>(size_, size_),
                                  Image<groundtruth::Surface>(size_, size_), Image<std::uint32_t>(size_, size_)};
    for (std::size_t i = 0; i < hits.id.size(); ++i) {
        hits.id[i] = pixels_[i].id;
        hits.triangle[i] = pixels_[i].triangle;
        hits.position[i] = pixels_[i].position;
        hits.surface[i] = pixels_[i].surface;
    }
    return hits;
}

} // namespace shadowbench::benchmarks
