package io.troupe.demo.terminal;

import java.nio.file.Path;

/** The folder of the installation, with the worlds that are the defaults of options. */
public final class Installation {
    /** The system property that the start scripts set; builds run in that folder. */
    public static final String PROPERTY = "troupe.home";

    private Installation() {}

    public static Path folder() {
        return Path.of(System.getProperty(PROPERTY, ""));
    }

    /** A file of {@code demo/worlds}. */
    public static Path world(String name) {
        return folder().resolve(Path.of("demo", "worlds", name));
    }
}
