package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;

/** The error output of a command line with a wrong option; the benchmark does not run. */
public final class WrongOption {
    private WrongOption() {}

    public static String of(Object benchmark, String... arguments) {
        var err = new StringWriter();
        int status = BenchmarkCommand.of(benchmark).setErr(new PrintWriter(err)).execute(arguments);
        assertThat(status).as(err.toString()).isEqualTo(2);
        return err.toString();
    }
}
