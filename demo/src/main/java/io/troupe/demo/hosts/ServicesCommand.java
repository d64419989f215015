package io.troupe.demo.hosts;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.ServiceOffer;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;
import io.troupe.view.Json;
import java.io.PrintWriter;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.concurrent.TimeoutException;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code troupe services}: who on a bus offers what, and how well. */
@Command(
        name = "services",
        description = "Shows which process on a bus offers which service, and how well.",
        footer = {
            "  troupe services --bus nats://base:4222",
            "  troupe services --bus nats://base:4222 --json",
            "",
            "The columns: the service, its capabilities, the node that offers it, whether it runs there, the time of a"
                    + " request to that node, how often the service was started there (life), its rank (the lower, the"
                    + " earlier it is chosen among equals), and the time since the node published it.",
            "States: idle (starts when it is needed), starting, running, suspect (the node or the service does not"
                    + " answer in time), failed."
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class ServicesCommand implements Callable<Integer> {
    /** Offers come at once when a node asks for them, and again each second. */
    private static final Duration WAIT = Duration.ofMillis(600);

    private static final Duration LIMIT = Duration.ofSeconds(30);

    @Spec
    private CommandSpec spec;

    @Mixin
    private BusOptions bus;

    @Option(names = "--json", description = "print one JSON array instead of a table")
    private boolean json;

    @Override
    public Integer call() throws InterruptedException {
        List<ServiceOffer> offers = offers();
        PrintWriter out = spec.commandLine().getOut();
        if (json) {
            out.println(
                    Json.objects(offers.stream().map(ServicesCommand::object).toList())
                            .text());
        } else if (offers.isEmpty()) {
            out.println("no service is offered on "
                    + String.join(", ", bus.settings().servers()) + " (application "
                    + bus.settings().application() + ")");
        } else {
            table(offers).forEach(out::println);
        }
        out.flush();
        return 0;
    }

    private List<ServiceOffer> offers() throws InterruptedException {
        try (var space = ActorSpace.create(SpaceSettings.named("services"));
                var node = bus.open(BusSettings.on(space))) {
            Broker broker = Broker.over(node, space, BrokerSettings.defaults().withObserver(event -> {}));
            try {
                return broker.services().offers(WAIT).get(LIMIT);
            } finally {
                broker.close();
            }
        } catch (TimeoutException late) {
            throw new BusException("the offers on the bus were not complete within " + LIMIT.toSeconds() + " s", late);
        }
    }

    // ---- the table

    static List<String> table(List<ServiceOffer> offers) {
        List<List<String>> rows = new ArrayList<>();
        rows.add(List.of("service", "capabilities", "node", "state", "round trip", "life", "rank", "age"));
        offers.forEach(offer -> rows.add(row(offer)));
        int[] widths = IntStream.range(0, rows.getFirst().size())
                .map(column -> rows.stream()
                        .mapToInt(row -> row.get(column).length())
                        .max()
                        .orElse(0))
                .toArray();
        return rows.stream().map(row -> line(row, widths)).toList();
    }

    private static List<String> row(ServiceOffer offer) {
        var provider = offer.provider();
        return List.of(
                provider.service(),
                provider.capabilities().isEmpty() ? "-" : String.join(", ", provider.capabilities()),
                provider.provider().node(),
                state(provider.health()),
                offer.roundTrip() == null ? "no answer" : decimal(millis(offer.roundTrip())) + " ms",
                "" + offer.life(),
                "" + offer.rank(),
                decimal(offer.age().toNanos() / 1e9) + " s");
    }

    private static String line(List<String> row, int[] widths) {
        var line = new StringBuilder();
        for (int column = 0; column < widths.length; column++) {
            line.append(String.format(Locale.ROOT, "%-" + (widths[column] + 2) + "s", row.get(column)));
        }
        return line.toString().stripTrailing();
    }

    private static String state(Health health) {
        return switch (health) {
            case NOT_STARTED, STOPPED -> "idle";
            case STARTING -> "starting";
            case WELL -> "running";
            case SUSPECT -> "suspect";
            case FAILED -> "failed";
        };
    }

    private static double millis(Duration duration) {
        return duration.toNanos() / 1e6;
    }

    private static String decimal(double number) {
        return String.format(Locale.ROOT, "%.1f", number);
    }

    // ---- JSON

    private static Json object(ServiceOffer offer) {
        var provider = offer.provider();
        @Nullable Duration roundTrip = offer.roundTrip();
        return new Json()
                .put("service", provider.service())
                .put("capabilities", Json.texts(provider.capabilities()))
                .put("node", provider.provider().node())
                .put("name", provider.provider().name())
                .put("state", state(provider.health()))
                .put("health", provider.health().name().toLowerCase(Locale.ROOT).replace('_', ' '))
                .put("roundTripMillis", roundTrip == null ? Double.NaN : millis(roundTrip))
                .put("life", offer.life())
                .put("rank", offer.rank())
                .put("ageSeconds", offer.age().toNanos() / 1e9);
    }
}
