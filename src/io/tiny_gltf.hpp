#pragma once

// TinyGLTF with its implementation, for the one file that writes glTF: as a library it would draw along those of images
// and of compressed meshes, which cost more to load than most scenes cost to run. It lies in a namespace of ours, so
// that a program may use another TinyGLTF beside it.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf trajet_tinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace trajet {
namespace tinygltf = ::trajet_tinygltf;
}
