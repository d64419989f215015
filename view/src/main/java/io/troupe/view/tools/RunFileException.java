package io.troupe.view.tools;

import io.troupe.common.text.SourceException;
import io.troupe.common.text.SourcePosition;
import java.nio.file.Path;

/**
 * Thrown for a file that is no run, or a run in another world. The message names the file, and the line where there is
 * one.
 */
public final class RunFileException extends SourceException {
    private static final long serialVersionUID = 1L;

    RunFileException(Path file, int line, int column, String problem) {
        super(new SourcePosition(file, line, column), problem);
    }

    RunFileException(Path file, String problem, Throwable cause) {
        super(file + ": " + problem, cause);
    }
}
