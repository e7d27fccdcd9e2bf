# What is installed of the simulator: library, headers that its users need, scenes, and the package that
# find_package(beltlife) finds. Included by CMakeLists.txt; the component "dev" is what only programs that embed it need.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers a user may include, and what these include in turn; tests/install sees that none is missing.
set(sim_headers
  model.h node_array.h plan.h range_models.h record.h run.h speed_profile.h state.h status.h
  eval/drive_model.h eval/evaluator.h eval/point.h eval/quantities.h eval/quantity_unit.h eval/run_ranges.h
  eval/summary.h eval/sweep.h
  kernels/kernel.h
  lanes/lane_array.h lanes/lane_belt.h
  life/life.h life/loads.h
  modes/campbell.h modes/linear_options.h modes/modes.h modes/operating_point.h
  route/arm_stops.h route/layout.h route/route.h
  scene/field.h scene/scene.h scene/scene_io.h scene/speed_csv.h
  schemes/scheme.h
  signal/bands.h signal/spectrum.h
  statics/quasi_static.h statics/take_up.h)
foreach(header ${sim_headers})
  get_filename_component(folder sim/${header} DIRECTORY)
  install(FILES sim/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/beltlife/${folder} COMPONENT dev)
endforeach()

# In this build the library hands on all that the other folders use. A program that embeds it is asked for less:
# - libraries to link, by which no flag or header of theirs comes along (the headers above name none of them);
# - the two options that the simulator's numbers hang on. Inline functions and templates that both sides instantiate are
#   merged by the linker into whichever copy comes first, so that the program's copies must give the same bits.
# Warnings, optimisation and instruction set stay the program's own.
add_library(beltlife::sim ALIAS beltlife_sim)
set_target_properties(beltlife_sim PROPERTIES EXPORT_NAME sim)
target_compile_features(beltlife_sim INTERFACE cxx_std_20)
target_include_directories(beltlife_sim INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/beltlife>)
target_link_libraries(beltlife_sim INTERFACE
  $<INSTALL_INTERFACE:$<LINK_ONLY:fmt::fmt>> $<INSTALL_INTERFACE:$<LINK_ONLY:OpenMP::OpenMP_CXX>>)
target_compile_definitions(beltlife_sim INTERFACE $<INSTALL_INTERFACE:EIGEN_DONT_PARALLELIZE>)
target_compile_options(beltlife_sim INTERFACE
  $<INSTALL_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-ffp-contract=off>>)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/beltlife)
install(TARGETS beltlife_sim EXPORT beltlife ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(EXPORT beltlife NAMESPACE beltlife:: FILE beltlife-targets.cmake DESTINATION ${package_dir} COMPONENT dev)
math(EXPR fmt_next "${fmt_VERSION_MAJOR} + 1")
configure_package_config_file(sim/beltlife-config.cmake.in ${PROJECT_BINARY_DIR}/beltlife-config.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/beltlife-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/beltlife-config.cmake ${PROJECT_BINARY_DIR}/beltlife-config-version.cmake
  DESTINATION ${package_dir} COMPONENT dev)
