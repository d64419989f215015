package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.services.subsumption.Mode;
import io.troupe.tools.SampleStatistics;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/** All measured numbers of an evaluation. */
final class Measurements {
    private static final String CSV_HEADER = "part,mode,cores_told,repetition,subject,quantity,unit,value";

    private final List<Measurement> all = new ArrayList<>();

    void add(Measurement measurement) {
        all.add(measurement);
    }

    List<Measurement> all() {
        return List.copyOf(all);
    }

    /** The measurements of repetitions 1 to {@code first}. */
    Measurements ofRepetitions(int first) {
        var some = new Measurements();
        all.stream().filter(each -> each.repetition() <= first).forEach(some::add);
        return some;
    }

    boolean has(Kind kind, Mode mode, int cores, String subject, Quantity quantity) {
        return values(kind, mode, cores, subject, quantity).length > 0;
    }

    /** Values by repetition; empty if not measured. */
    double[] values(Kind kind, Mode mode, int cores, String subject, Quantity quantity) {
        return all.stream()
                .filter(each -> each.kind() == kind
                        && each.mode() == mode
                        && each.cores() == cores
                        && each.subject().equals(subject)
                        && each.quantity() == quantity)
                .sorted(Comparator.comparingInt(Measurement::repetition))
                .mapToDouble(Measurement::value)
                .toArray();
    }

    /** @throws IllegalArgumentException if not measured */
    SampleStatistics statistics(Kind kind, Mode mode, int cores, String subject, Quantity quantity) {
        double[] values = values(kind, mode, cores, subject, quantity);
        if (values.length == 0) {
            throw new IllegalArgumentException(
                    quantity + " of " + subject + " in " + mode + " mode, " + kind + ", was not measured");
        }
        return SampleStatistics.of(values);
    }

    /** Ratios of values measured in the same repetition. */
    static double[] ratios(double[] numerators, double[] denominators) {
        if (numerators.length != denominators.length) {
            throw new IllegalArgumentException(
                    numerators.length + " numerators, expected " + denominators.length + " as there are denominators");
        }
        var ratios = new double[numerators.length];
        for (int index = 0; index < ratios.length; index++) {
            ratios[index] = numerators[index] / denominators[index];
        }
        return ratios;
    }

    /** Statistics of times in milliseconds, in seconds. */
    static SampleStatistics seconds(double[] millis) {
        return SampleStatistics.of(
                Arrays.stream(millis).map(each -> each / 1000).toArray());
    }

    /** Writes all measurements as CSV, one number per line. */
    void writeCsv(Path file) throws IOException {
        var lines = Stream.concat(Stream.of(CSV_HEADER), all.stream().map(Measurements::csvLine));
        OutputFiles.write(file, lines.collect(Collectors.joining("\n", "", "\n")));
    }

    private static String csvLine(Measurement each) {
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
