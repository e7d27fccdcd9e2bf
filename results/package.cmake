# What is installed of the program: command, scenes, examples, documents; and the Debian packages that CPack makes of
# everything (cpack -G DEB in the build folder). Included by CMakeLists.txt behind sim/install.cmake.
set(data_dir ${CMAKE_INSTALL_DATADIR}/beltlife)
file(RELATIVE_PATH module_dir ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/beltlife)
set_target_properties(beltlife PROPERTIES INSTALL_RPATH "$ORIGIN/${module_dir}")
install(TARGETS beltlife RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS beltlife_openturns LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/beltlife COMPONENT program)

# Study files name their scenes by paths between the folders of this tree, so the examples keep its shape: they work
# where they are, and so does a copy of the folder, which is where results can be written.
file(GLOB examples RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  sim/scenes/*.toml */examples/*.toml */examples/*/*.toml)
foreach(example ${examples})
  get_filename_component(folder ${example} DIRECTORY)
  install(FILES ${example} DESTINATION ${data_dir}/examples/${folder} COMPONENT program)
endforeach()
file(CREATE_LINK examples/sim/scenes ${PROJECT_BINARY_DIR}/scenes SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/scenes DESTINATION ${data_dir} COMPONENT program)
install(FILES tests/install/consumer/CMakeLists.txt tests/install/consumer/main.cpp
  DESTINATION ${data_dir}/examples/embed COMPONENT dev)

file(GLOB documents RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS README.md CHANGELOG.md sim/*.md sim/*/*.md
  studies/*.md calibrate/README.md optimize/README.md results/README.md results/*.md results/*/*.md results/*.svg
  results/reports/*/README.md)
list(REMOVE_DUPLICATES documents)
foreach(document ${documents})
  get_filename_component(folder ${document} DIRECTORY)
  install(FILES ${document} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT program)
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

# Two packages, as Debian's policy has it: who runs beltlife needs no headers, who embeds it needs neither OpenTURNS nor
# Ceres. Both state the licences of what is linked; Debian has the Apache licence itself, so that LICENSE stays out.
set(packages beltlife libbeltlife-dev)
set(components program dev)
foreach(package component IN ZIP_LISTS packages components)
  install(FILES results/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

find_program(gzip gzip)
if(gzip)  # Debian wants it compressed; without a time stamp, so that the same tree gives the same package
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz DEPENDS CHANGELOG.md
    COMMAND ${gzip} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${PROJECT_BINARY_DIR}/changelog.gz VERBATIM)
  add_custom_target(beltlife_changelog ALL DEPENDS ${PROJECT_BINARY_DIR}/changelog.gz)
  foreach(package component IN ZIP_LISTS packages components)
    install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
      COMPONENT ${component} OPTIONAL EXCLUDE_FROM_ALL)  # where only some targets are built there is none
  endforeach()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME beltlife)
set(CPACK_PACKAGE_CONTACT "beltlife developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulator of serpentine belt drives")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)  # a package each
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME beltlife)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)  # charts on pages
if(BELTLIFE_MPI)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS openmpi-bin)  # mpirun
endif()
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Simulates poly-V belt drives in time and predicts how long the belt lives:
tensions, slip, hub loads, vibration by crank orders, natural frequencies,
stresses and fatigue life over a duty cycle. With studies (sensitivity,
uncertainty, convergence), calibration against measured spectra, a search for
layouts that live longer, and a page about each result.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libbeltlife-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# The library is linked statically and calls fmt, whose names hold its major version.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libfmt-dev (>= ${fmt_VERSION_MAJOR}), libfmt-dev (<< ${fmt_next})")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS beltlife)
set(CPACK_DEBIAN_DEV_DESCRIPTION "The simulator inside beltlife, for programs that embed it: static library,
headers, a CMake package and an example. Reads scenes, simulates ranges,
evaluates batches of drives, gives tensions, orders, stresses and lives.")
include(CPack)
