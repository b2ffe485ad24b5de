// What a SPIR-V module asks of the pipeline that it is part of.
#pragma once

#include "gpu/pipeline.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowbench::gpu {

enum class Resource {
    SampledImage, // with its sampler
    Sampler,
    Image,
    StorageImage,
    UniformTexels,
    StorageTexels,
    UniformBuffer,
    StorageBuffer,
};

struct Binding {
    unsigned set = 0, number = 0;
    Resource resource;
    unsigned count = 1; // of an array; 1 of one without a size
};

enum class Scalar { Float, Int, Uint };

/// A location of an input or output.
struct Variable {
    unsigned location = 0;
    Scalar scalar = Scalar::Float;
    unsigned components = 1;
};

struct Module {
    Stage stage;
    std::string entry; // name of the function
    std::vector<Binding> bindings;
    std::vector<Variable> inputs, outputs; // arrays and matrices location by location; built-in ones are left out
    bool pushConstants = false;
};

/// Checks and reads a module. Throws BadInput naming `name` for one that is not valid, or has another number of entry points
/// than one, another stage, or an input or output of a type without locations.
Module readModule(const std::vector<std::uint32_t>& words, const std::string& name);

} // namespace shadowbench::gpu
