package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.stops;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;

class DeclarationErrorsTest {
    private static Protocol player() {
        return Protocol.of("player")
                .in("ready", provides("setValues").then("ready"))
                .build();
    }

    private static Protocol asking(String target) {
        return Protocol.of("robot").in("idle", requests(target).then("idle")).build();
    }

    private static void refused(ThrowingCallable call, String message) {
        assertThatIllegalArgumentException().isThrownBy(call).withMessage(message);
    }

    @Test
    void request_toUnknownComponent_namesTheNearest() {
        refused(
                () -> Wiring.of("w")
                        .component(asking("plaier.setValues"))
                        .component(player())
                        .build(),
                "wiring w: robot requests plaier.setValues in state idle, but there is no component plaier; did you mean"
                        + " player? known: robot, player");
    }

    @Test
    void request_thatIsNeverOffered_namesTheNearestCall() {
        refused(
                () -> Wiring.of("w")
                        .component(asking("player.setValue"))
                        .component(player())
                        .build(),
                "wiring w: robot requests player.setValue in state idle, but player never offers setValue; did you mean"
                        + " setValues? known: setValues");
        refused(
                () -> Wiring.of("w")
                        .component(asking("robot2.move"))
                        .component("robot2", asking("robot.move"))
                        .build(),
                "wiring w: robot requests robot2.move in state idle, but robot2 never offers move; there are none");
    }

    @Test
    void request_ofItself_isRefused() {
        refused(
                () -> Wiring.of("w").component(asking("robot.move")).build(),
                "wiring w: robot requests robot.move in state idle of itself; expected another component");
    }

    @Test
    void offer_thatNobodyRequests_mustBeOpen() {
        refused(
                () -> Wiring.of("w").component(player()).build(),
                "wiring w: player offers setValues, but nobody requests it; request it, or declare player.setValues"
                        + " open");
        refused(
                () -> Wiring.of("w").component(player()).open("player.setValue").build(),
                "wiring w: open call player.setValue is not offered; did you mean player.setValues? known:"
                        + " player.setValues");
        refused(
                () -> Wiring.of("w")
                        .component(player())
                        .component(asking("player.setValues"))
                        .open("player.setValues")
                        .build(),
                "wiring w: player.setValues is declared open and requested by [robot]; expected one of the two");
    }

    @Test
    void offer_twice_isRefused() {
        refused(
                () -> Protocol.of("p")
                        .in("a", provides("x").then("b"))
                        .in("b", provides("x").then("a")),
                "protocol p: call x is offered twice, in state a and in state b; expected one state that offers it");
    }

    @Test
    void state_thatCannotBeReached_isRefused() {
        refused(
                () -> Protocol.of("p")
                        .in("a", does("x").then("a"))
                        .in("b", does("y").then("a"))
                        .build(),
                "protocol p: state b cannot be reached from the first state a; expected a step that leads to it");
    }

    @Test
    void state_thatIsNotDeclared_namesTheNearest() {
        refused(
                () -> Protocol.of("p").in("driving", does("x").then("drivng")).build(),
                "protocol p: a step of state driving leads to state drivng, which is not declared; did you mean"
                        + " driving? known: driving");
    }

    @Test
    void state_declaredBadly_isRefused() {
        refused(() -> Protocol.of("p").build(), "protocol p: there are no states; expected 1 or more");
        refused(() -> Protocol.of("p").in("a"), "protocol p: nothing leads out of state a; expected a step or a stop");
        refused(
                () -> Protocol.of("p")
                        .in("a", does("x").then("a"))
                        .in("a", does("y").then("a")),
                "protocol p: state a is declared twice");
        refused(
                () -> Protocol.of("p").in("a", does("x").then("a"), does("x").then("a")),
                "protocol p: state a does x twice; expected different names for a choice");
        refused(
                () -> Protocol.of("p").in("a", stops()),
                "protocol p: state a is the first one and stops; expected a stop in a later state");
        refused(
                () -> Protocol.of("p").in(" a", stops()),
                "protocol p: a state is called \" a\", expected text without control characters or space around it");
    }

    @Test
    void names_ofCallsAndComponents_areWords() {
        refused(() -> asking("setValues"), "protocol robot: state idle requests setValues, expected component.call");
        refused(
                () -> asking("player.set values"),
                "protocol robot: the call of request player.set values is \"set values\", expected letters, digits, -"
                        + " and _ without spaces or dots");
        refused(
                () -> Wiring.of("w").component("a.b", player()),
                "wiring w: the name of a component is \"a.b\", expected letters, digits, - and _ without spaces or"
                        + " dots");
    }

    @Test
    void binding_toUnknownNames_isRefused() {
        var wiring = Wiring.of("w").component(asking("player.setValues")).component("player1", player());
        refused(
                () -> wiring.bind("robot", "player", "player2").build(),
                "wiring w: robot.player is bound to the unknown component player2; did you mean player1? known: robot,"
                        + " player1");
        refused(
                () -> wiring.bind("robot", "player", "player1"),
                "wiring w: robot.player is bound twice, to player2 and to player1");
        refused(
                () -> Wiring.of("w")
                        .component(player())
                        .bind("player", "robot", "player")
                        .build(),
                "wiring w: player.robot is bound, but player requests nothing of robot; there are none");
        refused(
                () -> Wiring.of("w")
                        .component(player())
                        .bind("playr", "robot", "player")
                        .build(),
                "wiring w: playr.robot is bound, but there is no component playr; did you mean player? known: player");
    }

    @Test
    void components_withTheSameName_areRefused() {
        refused(
                () -> Wiring.of("w").component(player()).component(player()),
                "wiring w: there are two components called player");
        refused(() -> Wiring.of("w").build(), "wiring w: there are no components; expected 1 or more");
        refused(
                () -> Wiring.of("w").components("p", 0, player()),
                "wiring w: there are 0 components p, expected 1 or more");
    }
}
