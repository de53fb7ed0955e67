add_executable(credo_clusters_bench clusters_bench.cpp)
credo_target_options(credo_clusters_bench)
target_include_directories(credo_clusters_bench SYSTEM PRIVATE ${PCL_INCLUDE_DIRS})
target_compile_definitions(credo_clusters_bench PRIVATE
  CREDO_DATA_DIR="${PROJECT_SOURCE_DIR}/../shared/data")
target_link_libraries(credo_clusters_bench PRIVATE
  credo_clustering credo_normals credo_io pcl_kdtree pcl_segmentation benchmark::benchmark_main)
