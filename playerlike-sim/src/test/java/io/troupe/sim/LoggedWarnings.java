package io.troupe.sim;

import java.io.ByteArrayOutputStream;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import java.util.logging.StreamHandler;

/** Collects what a class logs. */
public final class LoggedWarnings {
    private LoggedWarnings() {}

    /** Level and message of everything that a class logs during the action, one a line. */
    public static List<String> of(Class<?> logging, Runnable action) {
        var out = new ByteArrayOutputStream();
        var collector = new StreamHandler(out, new SimpleFormatter() {
            @Override
            public String format(LogRecord logged) {
                return logged.getLevel() + " " + formatMessage(logged) + "\n";
            }
        });
        Logger logger = Logger.getLogger(logging.getName());
        logger.addHandler(collector);
        logger.setUseParentHandlers(false);
        try {
            action.run();
        } finally {
            logger.removeHandler(collector);
            logger.setUseParentHandlers(true);
        }
        collector.close();
        return out.toString(StandardCharsets.UTF_8).lines().toList();
    }
}
