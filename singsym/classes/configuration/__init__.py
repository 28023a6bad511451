"""One configuration that a user gives: where it is exactly, its four ranks, types, class and null motions."""
