package io.troupe.checks.builds;

/** A part of a build file that its reader does not understand, and therefore cannot compare. */
final class BuildFileException extends RuntimeException {
    private static final long serialVersionUID = 1;

    BuildFileException(String message) {
        super(message);
    }
}
