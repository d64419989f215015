package io.troupe.services.component.application;

import io.troupe.common.text.SourceException;
import io.troupe.common.text.SourcePosition;

/** Thrown for an application file that cannot be read; the message has the error, and what was expected. */
public final class ApplicationFileException extends SourceException {
    private static final long serialVersionUID = 1L;

    public ApplicationFileException(SourcePosition where, String problem) {
        super(where, problem);
    }
}
