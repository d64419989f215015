package io.troupe.services.subsumption;

import java.nio.file.Path;

/**
 * Thrown if the services of a jar cannot be used. The message begins with the jar's path and describes what was
 * expected.
 */
public final class ServiceJarException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    ServiceJarException(Path jar, String problem, Throwable cause) {
        super(jar + ": " + problem, cause);
    }

    ServiceJarException(Path jar, String problem) {
        super(jar + ": " + problem);
    }
}
