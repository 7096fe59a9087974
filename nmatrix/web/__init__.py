"""The program in a browser: the folder that holds it, and the desk that answers there."""
