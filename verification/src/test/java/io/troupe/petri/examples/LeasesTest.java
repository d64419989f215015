package io.troupe.petri.examples;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.wiring.Branch;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringProgress;
import io.troupe.petri.wiring.WiringProgress.Fails;
import io.troupe.petri.wiring.WiringResult;
import java.util.ArrayList;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/**
 * A pool of connections that are lent for a time. No component waits for ever, and still more clients use connections
 * than there are: that is a question about safety.
 */
class LeasesTest {
    /** Two connections for three clients; a lease that expires gives one back while its client goes on to use it. */
    private static Wiring pool(boolean expires) {
        var pool = Protocol.of("pool");
        for (var free = 2; free >= 0; free--) {
            var ways = new ArrayList<Branch>();
            if (free > 0) {
                ways.add(provides("take").then("free " + (free - 1)));
            }
            if (free < 2) {
                ways.add(provides("give").then("free " + (free + 1)));
                if (expires) {
                    ways.add(does("a lease expires").then("free " + (free + 1)));
                }
            } else if (expires) {
                ways.add(provides("give").then("free 2")); // too late
            }
            pool.state("free " + free, ways.toArray(new Branch[0]));
        }
        var client = Protocol.of("client")
                .state("idle", requests("pool.take").then("using"))
                .state("using", does("use").then("done"))
                .state("done", requests("pool.give").then("idle"))
                .build();
        return Wiring.of("pool")
                .components("client", 3, client)
                .component(pool.build())
                .build();
    }

    private static final Map<String, Set<String>> ALL_USE =
            Map.of("client1", Set.of("using"), "client2", Set.of("using"), "client3", Set.of("using"));

    @Test
    void connections_areNeverUsedByMoreThanThereAre_unlessALeaseExpires() {
        assertThat(WiringCheck.check(pool(true))).isInstanceOf(WiringResult.Proved.class);
        assertThat(WiringProgress.of(pool(false)).never(ALL_USE)).isInstanceOf(Yes.class);
        var fails = ((No<Fails>) WiringProgress.of(pool(true)).never(ALL_USE)).counterexample();
        assertThat(fails.sentence()).isEqualTo("client1 is using, client2 is using, client3 is using");
        assertThat(fails.firings()).hasSize(13).contains("pool: a lease expires (in free 1)");
        assertThat(fails).hasToString("""
                client1 is using, client2 is using, client3 is using
                  after 4 steps:
                    1. client1 calls pool.take, which answers
                    2. pool: a lease expires (in free 1)
                    3. client2 calls pool.take, which answers
                    4. client3 calls pool.take, which answers""");
    }
}
