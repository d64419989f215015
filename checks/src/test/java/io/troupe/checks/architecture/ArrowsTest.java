package io.troupe.checks.architecture;

import static com.tngtech.archunit.base.DescribedPredicate.describe;
import static com.tngtech.archunit.base.DescribedPredicate.not;
import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideInAPackage;
import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideInAnyPackage;
import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideOutsideOfPackage;
import static com.tngtech.archunit.core.domain.properties.HasName.Predicates.name;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.classes;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses;
import static com.tngtech.archunit.library.dependencies.SlicesRuleDefinition.slices;

import com.tngtech.archunit.lang.ArchRule;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The allowed dependencies between packages. */
class ArrowsTest {
    private static final String PROMISE = "io.troupe.actor.promise";
    private static final String TIME = "io.troupe.actor.time";
    private static final String LOOP = "io.troupe.actor.internal.loop";
    private static final String INTERNAL = "io.troupe.actor.internal";
    private static final String ACTOR = "io.troupe.actor";
    private static final String COMMON = "io.troupe.common..";
    private static final String BUS = "io.troupe.bus";
    private static final String BROKER = "io.troupe.broker..";

    @ParameterizedTest
    @CsvSource({
        "common,         io.troupe.common..",
        "actor-core,     io.troupe.actor..",
        "actor-service,  io.troupe.bus.. io.troupe.broker..",
        "playerlike-sim, io.troupe.player.. io.troupe.sim..",
        "services,       io.troupe.services..",
        "verification,   io.troupe.petri..",
        "view,           io.troupe.view..",
        "demo,           io.troupe.demo..",
        "jmh,            io.troupe.bench..",
        "stress,         io.troupe.actor.."
    })
    void module_holdsOnlyItsOwnPackages(String module, String packages) {
        classes()
                .should()
                .resideInAnyPackage(packages.split(" "))
                .as("the module " + module + " should hold only " + packages)
                .allowEmptyShould(true)
                .check(Classes.of(module));
    }

    @Test
    void actorCore_importsNoOtherModule() {
        arrow("io.troupe.actor..").check(Classes.MAIN);
    }

    @Test
    void actorCore_takesOnlyItsFewLibraries() {
        classes()
                .that()
                .resideInAPackage("io.troupe.actor..")
                .should()
                .onlyDependOnClassesThat()
                .resideInAnyPackage(
                        "io.troupe.actor..",
                        "java..",
                        "jdk.jfr..",
                        "org.jspecify.annotations..",
                        "org.objectweb.asm..",
                        "org.objenesis..")
                .check(Classes.MAIN);
    }

    @Test
    void playerlikeSim_importsActorCore() {
        arrow("io.troupe.player..", "io.troupe.actor..", "io.troupe.sim..").check(Classes.MAIN);
        arrow("io.troupe.sim..", "io.troupe.actor..", "io.troupe.player..", COMMON)
                .check(Classes.MAIN);
    }

    @Test
    void simModel_importsCommonOnly() {
        arrow("io.troupe.sim.model", COMMON).check(Classes.MAIN);
    }

    @Test
    void simWorldfile_importsTheModelAndCommon() {
        arrow("io.troupe.sim.worldfile", "io.troupe.sim.model", COMMON).check(Classes.MAIN);
    }

    @Test
    void services_importActorsAndTheClientApi_neverTheSimulator() {
        arrow("io.troupe.services..", "io.troupe.actor..", BUS, BROKER, "io.troupe.player..", COMMON)
                .check(Classes.MAIN);
    }

    @Test
    void common_importsNoOtherModule() {
        arrow(COMMON).check(Classes.MAIN);
    }

    @Test
    void bus_importsActorCoreAndCommon() {
        arrow(BUS, "io.troupe.actor..", COMMON).check(Classes.MAIN);
    }

    @Test
    void broker_knowsOfTheBusOnlyItsAddresses() {
        arrow(BROKER, "io.troupe.actor..", COMMON, BUS).check(Classes.MAIN);
        noClasses()
                .that()
                .resideInAPackage(BROKER)
                .should()
                .dependOnClassesThat(describe(
                        "are of the bus, but not its Address",
                        resideInAPackage(BUS).and(not(name(BUS + ".Address")))))
                .check(Classes.MAIN);
    }

    @Test
    void verification_importsCommon() {
        arrow("io.troupe.petri..", COMMON).check(Classes.MAIN);
    }

    @Test
    void theNetEngine_importsCommonForPnmlOnly() {
        arrow("io.troupe.petri", COMMON).check(Classes.MAIN);
        arrow("io.troupe.petri.structure", "io.troupe.petri").check(Classes.MAIN);
    }

    @Test
    void view_importsServicesAndTheSimulator() {
        arrow(
                        "io.troupe.view..",
                        "io.troupe.actor..",
                        BUS,
                        BROKER,
                        "io.troupe.player..",
                        "io.troupe.sim..",
                        "io.troupe.services..",
                        COMMON)
                .check(Classes.MAIN);
    }

    @Test
    void loop_importsTime() {
        arrow(LOOP, TIME).check(Classes.MAIN);
    }

    @Test
    void promise_importsLoop() {
        arrow(PROMISE, LOOP).check(Classes.MAIN);
    }

    @Test
    void internal_importsPromiseAndLoop() {
        arrow(INTERNAL, PROMISE, LOOP).check(Classes.MAIN);
    }

    @Test
    void time_importsNoOtherRoom() {
        arrow(TIME).check(Classes.MAIN);
    }

    @Test
    void actor_importsPromiseAndTimeAndTheInternalPackages() {
        arrow(ACTOR, PROMISE, TIME, INTERNAL, LOOP).check(Classes.MAIN);
    }

    @Test
    void testkit_importsActor() {
        arrow("io.troupe.actor.testkit..", ACTOR, PROMISE, TIME).check(Classes.MAIN);
    }

    @Test
    void packages_haveNoCycles() {
        slices().matching("io.troupe.(**)").should().beFreeOfCycles().check(Classes.MAIN);
    }

    /**
     * Classes in {@code from} may depend on each other, on the packages in {@code to}, and on classes outside of
     * Troupe.
     */
    private static ArchRule arrow(String from, String... to) {
        var seen = Stream.concat(Stream.of(from), Stream.of(to)).toArray(String[]::new);
        var allowed = resideInAnyPackage(seen).or(resideOutsideOfPackage("io.troupe.."));
        var names = to.length == 0 ? "itself" : "itself and " + String.join(", ", to);
        return classes()
                .that()
                .resideInAPackage(from)
                .should()
                .onlyDependOnClassesThat(describe("reside in no other room of Troupe than " + names, allowed))
                .allowEmptyShould(true);
    }
}
