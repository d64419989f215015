package io.troupe.bench;

import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Unknown;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.petri.PnmlException;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.deadlock.DeadlockCheck;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.Callable;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

/**
 * Asks {@link DeadlockCheck} whether each net of a folder of PNML files can deadlock, and, if they are there, compares
 * the answers with those of verifypn and with the expected ones of the Model Checking Contest. The files are not part
 * of this project; the page about the method has their sources.
 *
 * <p>Prints a line of values separated by tabs for each file, then the summary.
 */
@Command(
        name = "CompareDeadlocks",
        description = "Decides whether the nets of a folder can deadlock, beside verifypn.",
        showDefaultValues = true)
public final class CompareDeadlocks implements Callable<Integer> {
    private static final Pattern FORMULA = Pattern.compile("FORMULA \\S+ (TRUE|FALSE)");
    private static final String QUESTION = """
            <property-set xmlns="http://mcc.lip6.fr/"><property><id>deadlock</id><description>can deadlock</description>
            <formula><exists-path><finally><deadlock/></finally></exists-path></formula></property></property-set>
            """;

    @Parameters(paramLabel = "FOLDER", description = "with a file NAME.pnml for each net")
    Path folder = Path.of(".");

    @Option(names = "--seconds", paramLabel = "N", converter = AtLeastOne.class, description = "for each net and tool")
    int seconds = 12;

    @Option(names = "--max-kib", paramLabel = "N", converter = AtLeastOne.class, description = "largest file")
    int maxKib = 300;

    @Option(names = "--every", paramLabel = "N", converter = AtLeastOne.class, description = "only every Nth file")
    int every = 1;

    @Option(names = "--verifypn", paramLabel = "FILE", description = "the other tool; without it only ours is run")
    @Nullable
    Path verifypn;

    @Option(names = "--expected", paramLabel = "FOLDER", description = "with a file NAME-RD.out for each net")
    @Nullable
    Path expected;

    public static void main(String... arguments) {
        System.exit(BenchmarkCommand.of(new CompareDeadlocks()).execute(arguments));
    }

    /** The answer to whether a net can deadlock. */
    enum Answer {
        YES,
        NO,
        UNKNOWN
    }

    /**
     * An answer, and how it came about.
     *
     * @param millis by the wall clock
     * @param how what decided it, or why it is not known
     */
    record Timed(Answer answer, long millis, String how) {}

    /** The answers for one net; those that were not asked for are unknown. */
    record Row(String name, String size, Timed ours, Timed peer, Answer consensus) {
        @Override
        public String toString() {
            return String.join(
                    "\t",
                    name,
                    size,
                    ours.answer.name(),
                    String.valueOf(ours.millis),
                    ours.how,
                    peer.answer.name(),
                    String.valueOf(peer.millis),
                    consensus.name());
        }
    }

    @Override
    public Integer call() throws IOException, InterruptedException {
        var question = Files.createTempFile("deadlock", ".xml");
        Files.writeString(question, QUESTION);
        var rows = new TreeMap<String, Row>();
        System.out.println("net\tplaces, transitions\tours\tms\tby\tverifypn\tms\texpected");
        try {
            var files = files();
            for (var i = 0; i < files.size(); i += every) {
                var row = compare(files.get(i), question);
                rows.put(row.name, row);
                System.out.println(row);
            }
        } finally {
            Files.delete(question);
        }
        System.out.println();
        summary(List.copyOf(rows.values())).forEach(System.out::println);
        return 0;
    }

    /** The files, small ones first. */
    private List<Path> files() throws IOException {
        try (var all = Files.list(folder)) {
            return all.filter(file -> file.toString().endsWith(".pnml") && bytes(file) <= maxKib * 1024L)
                    .sorted(Comparator.comparingLong(CompareDeadlocks::bytes).thenComparing(file -> file))
                    .toList();
        }
    }

    private static long bytes(Path file) {
        try {
            return Files.size(file);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private Row compare(Path file, Path question) throws IOException, InterruptedException {
        var name = file.getFileName().toString().replaceAll("\\.pnml$", "");
        var start = System.nanoTime();
        PetriNet net;
        try {
            net = Pnml.read(file, warning -> {});
        } catch (PnmlException e) {
            return new Row(
                    name,
                    "",
                    new Timed(Answer.UNKNOWN, 0, "refused: " + e.getMessage()),
                    peer(file, question),
                    expected(name));
        }
        var ours = decide(net, start);
        var size = net.places().size() + ", " + net.transitions().size();
        return new Row(name, size, ours, peer(file, question), expected(name));
    }

    private Timed decide(PetriNet net, long start) {
        var end = start + TimeUnit.SECONDS.toNanos(seconds);
        var limits = SearchLimits.markings(Integer.MAX_VALUE)
                .cancelledBy(() -> System.nanoTime() > end)
                .within(Runtime.getRuntime().maxMemory() * 6 / 10);
        Decided decided;
        try {
            decided = Decided.of(DeadlockCheck.decide(net, limits));
        } catch (ArithmeticException | OutOfMemoryError e) {
            decided = new Decided(Answer.UNKNOWN, e.toString());
        }
        var millis = TimeUnit.NANOSECONDS.toMillis(System.nanoTime() - start);
        return new Timed(millis > seconds * 1000L ? Answer.UNKNOWN : decided.answer, millis, decided.how);
    }

    /** An answer, and what decided it. */
    private record Decided(Answer answer, String how) {
        static Decided of(io.troupe.petri.Answer<Deadlock> isFree) {
            return switch (isFree) {
                case No<Deadlock>(var found) ->
                    new Decided(Answer.YES, found.trace().size() + " firings");
                case Yes<Deadlock>(var proof, var markings) -> new Decided(Answer.NO, proof);
                case Unknown<Deadlock>(var end, var markings) ->
                    new Decided(Answer.UNKNOWN, end + " after " + markings + " markings");
            };
        }
    }

    private Timed peer(Path file, Path question) throws IOException, InterruptedException {
        if (verifypn == null) {
            return new Timed(Answer.UNKNOWN, 0, "");
        }
        var output = Files.createTempFile("verifypn", ".txt");
        var start = System.nanoTime();
        var process = new ProcessBuilder(verifypn.toString(), "-x", "1", file.toString(), question.toString())
                .redirectErrorStream(true)
                .redirectOutput(output.toFile())
                .start();
        if (!process.waitFor(seconds, TimeUnit.SECONDS)) {
            process.destroyForcibly().waitFor();
        }
        var millis = TimeUnit.NANOSECONDS.toMillis(System.nanoTime() - start);
        var text = Files.readString(output, StandardCharsets.ISO_8859_1);
        Files.delete(output);
        return new Timed(answer(text), millis, "");
    }

    private Answer expected(String name) throws IOException {
        if (expected == null) {
            return Answer.UNKNOWN;
        }
        var file = expected.resolve(name + "-RD.out");
        return Files.exists(file) ? answer(Files.readString(file)) : Answer.UNKNOWN;
    }

    /** The answer in a text in the form of the contest. */
    static Answer answer(String text) {
        var found = FORMULA.matcher(text);
        if (!found.find()) {
            return Answer.UNKNOWN;
        }
        return "TRUE".equals(found.group(1)) ? Answer.YES : Answer.NO;
    }

    /** The numbers of nets, and those that need an explanation. */
    static List<String> summary(List<Row> rows) {
        Map<String, Long> counts = new TreeMap<>();
        var lines = new ArrayList<String>();
        for (var row : rows) {
            var ours = row.ours.answer;
            var peer = row.peer.answer;
            var key = ours == Answer.UNKNOWN
                    ? peer == Answer.UNKNOWN ? "neither" : "only verifypn"
                    : peer == Answer.UNKNOWN ? "only ours" : "both";
            counts.merge(key, 1L, Long::sum);
            if (ours != Answer.UNKNOWN && row.consensus != Answer.UNKNOWN) {
                counts.merge(ours == row.consensus ? "as expected" : "not as expected", 1L, Long::sum);
            }
            if (key.equals("only verifypn")
                    || ours != Answer.UNKNOWN
                            && (peer != Answer.UNKNOWN && peer != ours
                                    || row.consensus != Answer.UNKNOWN && row.consensus != ours)) {
                lines.add(row.toString());
            }
        }
        counts.forEach((key, count) -> lines.add(String.format(Locale.ROOT, "%s: %d of %d", key, count, rows.size())));
        return lines;
    }
}
