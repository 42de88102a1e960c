Command exited with non-zero status 5
0.00
