package io.troupe.demo.evaluate;

import io.troupe.demo.terminal.OutputFiles;
import java.io.IOException;
import java.nio.file.Path;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/** Writes all measurements as CSV, one number per line. */
final class EvaluationCsv {
    static final String HEADER = "part,mode,cores_told,repetition,subject,quantity,unit,value";

    private EvaluationCsv() {}

    static void write(Measurements measurements, Path file) throws IOException {
        var lines = Stream.concat(Stream.of(HEADER), measurements.all().stream().map(EvaluationCsv::line));
        OutputFiles.write(file, lines.collect(Collectors.joining("\n", "", "\n")));
    }

    private static String line(Measurement each) {
        return String.join(
                ",",
                each.kind().toString(),
                each.mode().toString(),
                Integer.toString(each.cores()),
                Integer.toString(each.repetition()),
                each.subject(),
                each.quantity().toString(),
                each.quantity().unit(),
                Double.toString(each.value()));
    }
}
