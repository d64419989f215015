package io.troupe.bench.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.bench.BenchmarkTests;
import io.troupe.bench.bus.BusWorkload.Part;
import io.troupe.tools.NatsServerProcess;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

@Timeout(value = 120, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // only against hanging
class CompareBusesTest {
    private static CompareBuses parsed(String... arguments) {
        return BenchmarkTests.parsed(new CompareBuses(), arguments);
    }

    @Test
    void noOption_comparesAll() {
        assertThat(parsed())
                .extracting(
                        each -> each.parts.size(),
                        each -> each.comparison.rounds,
                        each -> each.turnMillis,
                        each -> each.comparison.seed)
                .containsExactly(4, 15, 500, 1L);
    }

    @Test
    void options_areRead_andQuickReplacesThoseBeforeIt() {
        var options = parsed("--rounds", "8", "--quick", "--turn", "7", "--parts", "codec,ask", "--figure", "a.svg");
        assertThat(options.parts).containsExactly(Part.CODEC, Part.ASK);
        assertThat(options)
                .extracting(
                        each -> each.comparison.rounds,
                        each -> each.turnMillis,
                        each -> each.comparison.warmUpMillis,
                        each -> each.comparison.figure)
                .containsExactly(5, 7, 2_000, Path.of("a.svg"));
    }

    @Test
    void wrongOptions_areRefused() {
        assertThat(errorOf("--parts", "mqtt")).startsWith("--parts is mqtt, expected one of codec, ask, publish");
        assertThat(errorOf("--rounds", "0")).startsWith("--rounds is 0, expected 1 or more");
        assertThat(errorOf("--slow")).contains("'--slow'", "Usage: CompareBuses");
    }

    private static String errorOf(String... arguments) {
        return BenchmarkTests.errorOf(new CompareBuses(), arguments);
    }

    @Test
    void withoutServer_endsWithStatus3() throws Exception {
        assertThat(new CompareBuses().call(false)).isEqualTo(3);
    }

    @ParameterizedTest
    @EnumSource(
            value = BusContender.class,
            names = {"TROUPE", "JACKSON"})
    void codecs_giveBackTheirValues_andAreMeasured(BusContender contender) throws Exception {
        var child = new BusProcess.Child(contender, "none");
        for (BusWorkload each : Part.CODEC.workloads()) {
            BusTurn turn = child.turn(each, 1);
            assertThat(turn.micros()).as(each.label()).hasSize(1).allMatch(micros -> micros > 0);
            assertThat(BusTurn.parse(turn.line())).isEqualTo(turn);
        }
    }

    @Test
    void busInOneProcess_answersAndPublishesAll_andKeepsItsFrames() throws Exception {
        var sample = LoopEngine.Sample.of(1_000);
        assertThat(sample.request()).hasSizeGreaterThan(1_000);
        assertThat(sample.reply()).hasSizeGreaterThan(1_000);
        assertThat(sample.publication()).hasSizeBetween(16 * 9, 1_000);
        assertThat(LoopEngine.Sample.callBytes(1_000)).isGreaterThan(sample.request().length);
    }

    @Test
    void memoryOfANode_withoutConnection_isMeasured() throws Exception {
        var cost = new BusProcess.Child(BusContender.TROUPE, "none").costOf(BusResults.Node.ALONE);
        assertThat(cost.heapBytes()).isPositive();
        // of a node; another thread of the JVM may end between the two counts
        assertThat(cost.threads()).isBetween(-0.5, 0.5);
        assertThat(BusMemory.Cost.parse(cost.line())).isEqualTo(cost);
    }

    @ParameterizedTest
    @EnumSource(
            value = BusContender.class,
            names = {"TROUPE", "ACTOR", "RAW"})
    void pairs_overARealServer_loseNothing_andAreMeasured(BusContender contender) throws Exception {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
        try (var server = NatsServerProcess.start()) {
            var child = new BusProcess.Child(contender, server.address());
            for (BusWorkload each : Part.ASK.workloads()) {
                BusTurn turn = child.turn(each, 1);
                assertThat(turn.micros())
                        .as(each.label())
                        .hasSameSizeAs(BusTurn.SHARES)
                        .isSorted();
                assertThat(BusTurn.parse(turn.line())).isEqualTo(turn);
            }
            if (Part.PUBLISH.contenders().contains(contender)) {
                assertThat(child.turn(BusWorkload.PUBLISH, 1).micros(0.5)).isPositive();
            }
            child.close();
        }
    }
}
