package io.troupe.bench;

import java.util.Arrays;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.ITypeConverter;

/** All contenders by name. The first is the limit, which the ratios refer to. */
enum Contenders {
    LIMIT("limit", Limit::new),
    FLOOR("floor", FloorContender::new),
    TROUPE("troupe", TroupeContender::new),
    EXECUTOR("executor", ExecutorContender::new),
    VIRTUAL_THREAD("virtual-thread", VirtualThreadContender::new),
    CHANNELS("channels", ChannelContender::new),
    VERTX("vertx", VertxContender::new),
    VERTX_BUS("vertx-bus", VertxBusContender::new),
    PEKKO("pekko", PekkoContender::withDefaults),
    PEKKO_ONE_THREAD("pekko-1t", PekkoContender::withOneThread),
    KONTRAKTOR("kontraktor", KontraktorContender::new);

    private final String label;
    private final Callable<Contender> factory;

    Contenders(String label, Callable<Contender> factory) {
        this.label = label;
        this.factory = factory;
    }

    String label() {
        return label;
    }

    Contender start() throws Exception {
        return factory.call();
    }

    static Contenders named(String label) {
        return Arrays.stream(values())
                .filter(each -> each.label.equals(label))
                .findFirst()
                .orElseThrow(() -> BenchmarkCommand.unknown(label, labels()));
    }

    /** Converts labels. */
    static final class Converter implements ITypeConverter<Contenders> {
        @Override
        public Contenders convert(String label) {
            return named(label);
        }
    }

    @Override
    public String toString() {
        return label;
    }

    static List<String> labels() {
        return Arrays.stream(values()).map(Contenders::label).toList();
    }
}
