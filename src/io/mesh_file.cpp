#include "mesh_file.hpp"

#include <filesystem>

#ifdef TRAJET_WITH_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace trajet::detail {

TriangleMesh read_mesh(const TableReader& table) {
  const std::string name = table.text("file");
#ifdef TRAJET_WITH_ASSIMP
  const std::filesystem::path path = std::filesystem::path(table.where().file.str()).parent_path() / name;
  Assimp::Importer importer;
  // lines and points have no volume
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                              aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw FileError(table.where("file"), importer.GetErrorString());
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = static_cast<int>(mesh.vertices.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i)
      mesh.vertices.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      const auto corner = [&](unsigned k) { return first + static_cast<int>(face.mIndices[k]); };
      if (face.mNumIndices == 3) mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
  return mesh;
#else
  throw InputError(table.where("file"),
                   "this trajet was built without assimp (TRAJET_ASSIMP) and reads no mesh files: '" + name + "'");
#endif
}

}  // namespace trajet::detail
