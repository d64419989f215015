package io.troupe.services.subsumption;

import io.troupe.common.text.SourceException;
import io.troupe.common.text.SourcePosition;

/** Thrown for a table file that cannot be read; the message describes what was expected. */
public final class SubsumptionTableException extends SourceException {
    private static final long serialVersionUID = 1L;

    SubsumptionTableException(SourcePosition where, String problem) {
        super(where, problem);
    }

    SubsumptionTableException(String problem, Throwable cause) {
        super(problem, cause);
    }
}
