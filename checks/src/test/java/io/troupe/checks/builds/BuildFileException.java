package io.troupe.checks.builds;

/** Something in a build file that its reader does not understand, and therefore does not compare. */
final class BuildFileException extends RuntimeException {
    private static final long serialVersionUID = 1;

    BuildFileException(String message) {
        super(message);
    }
}
