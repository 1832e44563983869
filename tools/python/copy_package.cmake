# Copies the package of the build tree: cmake -DPACKAGE=FOLDER -DTO=FOLDER -P copy_package.cmake
file(COPY ${PACKAGE}/ DESTINATION ${TO} PATTERN "__pycache__" EXCLUDE)
