package io.troupe.services.subsumption;

import java.nio.file.Path;

/** A jar whose kinds of services cannot be used; the message begins with its path and says what was expected. */
public final class ServiceJarException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    ServiceJarException(Path jar, String problem, Throwable cause) {
        super(jar + ": " + problem, cause);
    }

    ServiceJarException(Path jar, String problem) {
        super(jar + ": " + problem);
    }
}
