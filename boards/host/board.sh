# A PC: the reference of what the boards print.
compiler=${CC:-cc}
cpu=()
sources=(host/host.c common/text.c)
run=()
