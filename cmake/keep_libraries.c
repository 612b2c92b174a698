/* Linked into sanitized programs: plug-ins of Open MPI stay loaded, so that the leak report can name
   them and tests/lsan.supp can tell their leaks from ours. */
int dlclose(void* handle);
int dlclose(void* handle) {
  (void)handle;
  return 0;
}
