package io.troupe.demo.verify;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.demo.CommandLineBench;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.bip.BipStates;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.kinds.ComponentKinds;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;

/** {@code troupe verify --bip}: the paper's robots, and models that are derived from applications. */
@Execution(ExecutionMode.CONCURRENT)
class BipCommandTest extends CommandLineBench {
    private static final String SMALL = """
            application small
            component robots is player port=1 robots=1
            component first is wallFollower
            component spare is wallFollower
            small needs service player
            robot1 needs service wallFollower
            """;

    private static ApplicationPlan plan(String text) {
        return ApplicationReader.parse(text, Path.of("test.app"), ComponentKinds.standard(), Map.of());
    }

    @Test
    void bip_withoutAFile_isThePapersModel() throws IOException {
        assertThat(printed("verify --bip --out DIR"))
                .contains(
                        "18 states, 41 interactions, all of them",
                        "robot 1 has two services that are not off: never",
                        "84 states, 272 interactions, all of them",
                        "robot 2 has two services that are not off: 30 of 84 states, first after start1, see2_by2, stop1,"
                                + " start2",
                        "3 states, 14 interactions, all of them")
                .doesNotContain("NOT THE SAME");
        assertWritten("two_robots.bip", "two_robots_not_waiting.svg");
        assertThat(ReachabilityGraph.explore(Pnml.read(directory.resolve("two_robots.pnml")))
                        .size())
                .isEqualTo(18);
        assertThat(directory.resolve("two_robots.svg"))
                .as("the picture in the guide")
                .hasSameTextualContentAs(Path.of("..", "docs", "figures", "bip-two-robots.svg"));
        assertThat(directory.resolve("two_robots_by_priorities.svg"))
                .as("the picture in the guide")
                .hasSameTextualContentAs(Path.of("..", "docs", "figures", "bip-two-robots-by-priorities.svg"));
    }

    @Test
    void bip_ofAnApplication_findsThatItCanBeEnded_andWritesOneFile() throws IOException {
        assertThat(printed("verify --bip applications/python.app --out DIR/model.bip"))
                .contains(
                        "1204 states, 6875 interactions, all of them",
                        "as a net of 67 places and 144 transitions: the same",
                        "the application can be ended from every state");
        assertThat(written("model.bip")).startsWith("package two_languages\n").endsWith("  end\nend\n");
        assertMissing("model.svg");
        assertThat(printed("verify --bip applications/python.app --out DIR/model.svg"))
                .contains("wrote");
        assertThat(written("model.svg")).startsWith("<?xml").contains("class=\"trigger\"");
    }

    @Test
    void badFiles_areRefusedWithOneLine() throws IOException {
        file("bad.app", "application bad\ncomponent x is wallFolower\n");
        file("no.app", "nothing\n");

        assertRefused("verify --bip DIR/missing.app", "missing.app: no such file, expected the file of a declaration");
        assertRefused("verify --bip DIR/bad.app", "bad.app:2:16", "wallFollower");
        assertRefused("verify --bip DIR/no.app", "no.app:1:1");
        assertRefused("verify --bip DIR --out DIR", "a directory, expected");
        assertRefused("verify --bip DIR/no.app --net DIR/no.app", "--net and --bip are given, expected one of them");
        assertRefused(
                "verify --bip --out DIR/none/model.bip", "--out is DIR/none/model.bip, but there is no directory");
    }

    @Test
    void search_thatDoesNotEndInTime_isUnknown() throws IOException {
        file("small.app", SMALL);

        assertThat(troupe("verify --time 0.000001 --bip DIR/small.app --out DIR"))
                .isEqualTo(BipStudy.UNKNOWN);
        assertThat(out.toString()).contains("cancelled", "so far");
    }

    // ---- what follows from a derived model

    @Test
    void need_prefersTheFirstProvider_andTakesTheSecondWhenThatFails() {
        var states = BipStates.explore(ApplicationBip.of(plan(SMALL)));

        assertThat(states.isComplete()).isTrue();
        assertThat(states.find(state -> state.isIn("need2", "using_first"))
                        .orElseThrow()
                        .trace())
                .extracting(Object::toString)
                .containsSubsequence("need2_start_first", "first_invoked", "need2_began_first");
        assertThat(states.find(state -> state.isIn("need2", "using_spare"))
                        .orElseThrow()
                        .trace())
                .extracting(Object::toString)
                .containsSubsequence("first_fails", "need2_start_spare");
        assertThat(states.find(state -> state.isIn("need2", "using_spare") && state.isIn("first", "not_invoked")))
                .as("a second choice")
                .isEmpty();
    }

    @Test
    void failure_isNoticedByItsUsersAtOnce() {
        var states = BipStates.explore(ApplicationBip.of(plan(SMALL)));

        assertThat(states.find(state -> state.isIn("need2", "using_first") && state.isIn("first", "failed")))
                .isEmpty();
    }

    @Test
    void missingProvider_leadsToTheEndAndNowhereElse() {
        var states = BipStates.explore(ApplicationBip.of(
                plan("application alone\ncomponent x is wallFollower\nalone needs service camera\n")));

        assertThat(states.find(state -> state.isIn("application", "runs"))).isEmpty();
        assertThat(states.dead()).isNotEmpty().allMatch(ApplicationBip::hasEnded);
        assertThat(states.dead()).anyMatch(state -> state.isIn("need1", "gave_up"));
        assertThat(states.neverAgain(ApplicationBip::hasEnded)).isEmpty();
    }

    @Test
    void ended_nothingRunsAnyMore() {
        var states = BipStates.explore(ApplicationBip.of(plan(SMALL)));

        assertThat(states.count(ApplicationBip::hasEnded)).isPositive();
        for (var component : List.of("robots", "first", "spare")) {
            assertThat(states.find(state -> ApplicationBip.hasEnded(state)
                            && state.isIn(component, "invoking", "running", "terminating")))
                    .isEmpty();
        }
    }

    @Test
    void replacement_exchangesTheProviderInOneInteraction_andStopsTheOld() {
        var states = BipStates.explore(ApplicationBip.of(plan(SMALL + "at 1s replace first by spare\n")));

        assertThat(states.find(state -> state.isIn("need2", "using_first") && state.isIn("replacement1", "stopping")))
                .isEmpty();
        var done = states.find(state -> state.isIn("replacement1", "done") && state.isIn("first", "terminated_"));
        assertThat(done.orElseThrow().trace())
                .extracting(Object::toString)
                .containsSubsequence(
                        "replacement1_begin", "replacement1_began", "replacement1_exchange", "replacement1_terminate");
        assertThat(states.neverAgain(ApplicationBip::hasEnded)).isEmpty();
    }

    @Test
    void values_passOnlyToTheProviderInUse() {
        var states = BipStates.explore(ApplicationBip.of(plan(SMALL)));

        assertThat(states.states()).allSatisfy(state -> {
            var names = state.successors().stream()
                    .map(each -> each.interaction().toString())
                    .toList();
            var passes = names.contains("robots_robot1_sonar_to_first_sonar_need2");
            assertThat(passes)
                    .isEqualTo(state.isIn("robots", "running")
                            && state.isIn("first", "running")
                            && state.isIn("need2", "using_first"));
            assertThat(names.contains("robots_robot1_sonar") && passes).isFalse();
        });
    }

    @Test
    void names_thatTheLanguageDoesNotAllow_areChanged() {
        var model = ApplicationBip.of(
                plan("application two-words\ncomponent end is wallFollower\ncomponent a-b is wallFollower\n"
                        + "component a_b is wallFollower\ntwo-words needs service wallFollower\n"));

        assertThat(model.name()).isEqualTo("two_words");
        assertThat(model.components()).containsKeys("end_", "a_b", "a_b_", "application");
    }

    @Test
    void secondReplacementOfAComponent_isRefused() {
        var plan = plan(SMALL + "component third is wallFollower\nat 1s replace first by spare\n"
                + "at 2s replace spare by third\n");

        assertThatIllegalArgumentException()
                .isThrownBy(() -> ApplicationBip.of(plan))
                .withMessage("spare takes part in 2 replacements, expected one: the model has no more");
    }
}
