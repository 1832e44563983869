# Writes to OUT the completion that MALUS prints for bash.
execute_process(COMMAND ${MALUS} completion bash OUTPUT_VARIABLE script COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${OUT} "${script}")
