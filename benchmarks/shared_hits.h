// Primary hits in memory that a process shares with its children.
#pragma once

#include "groundtruth/contract/reference.h"

#include <memory>

namespace shadowbench::benchmarks {

class SharedHits {
public:
    explicit SharedHits(int size); // of a square image
    ~SharedHits();
    SharedHits(const SharedHits&) = delete;
    SharedHits& operator=(const SharedHits&) = delete;

    void store(const groundtruth::PrimaryHits& hits) const;
    [[nodiscard]] groundtruth::PrimaryHits load() const;

private:
    struct Pixel {
        std::uint32_t id, triangle;
        glm::vec3 position;
        groundtruth::Surface surface;
    };
    int size_;
    Pixel* pixels_;
};

} // namespace shadowbench::benchmarks
