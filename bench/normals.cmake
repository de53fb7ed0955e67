add_executable(credo_normals_bench normals_bench.cpp)
credo_target_options(credo_normals_bench)
target_include_directories(credo_normals_bench SYSTEM PRIVATE ${PCL_INCLUDE_DIRS})
target_compile_definitions(credo_normals_bench PRIVATE
  CREDO_DATA_DIR="${PROJECT_SOURCE_DIR}/../shared/data")
target_link_libraries(credo_normals_bench PRIVATE
  credo_normals credo_io pcl_features pcl_kdtree pcl_search TBB::tbb benchmark::benchmark_main)
