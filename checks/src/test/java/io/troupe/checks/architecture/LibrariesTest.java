package io.troupe.checks.architecture;

import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses;

import java.util.List;
import org.junit.jupiter.api.Test;

/** The libraries that each module and package may use. */
class LibrariesTest {
    @Test
    void jbox2d_staysInThePhysicsRoom_andWhereItIsAPeer() {
        library("org.jbox2d..", "io.troupe.sim.physics", "io.troupe.bench.worlds");
    }

    @Test
    void dyn4j_staysWhereItIsAPeer() {
        library("org.dyn4j..", "io.troupe.bench.worlds");
    }

    @Test
    void asm_staysInTheActorRoom() {
        library("org.objectweb.asm..", "io.troupe.actor");
    }

    @Test
    void objenesis_staysInTheActorRoom() {
        library("org.objenesis..", "io.troupe.actor");
    }

    @Test
    void ojalgo_staysInTheStructureRoom() {
        library("org.ojalgo..", "io.troupe.petri.structure");
    }

    @Test
    void elkAndWhatItBrings_stayInTheDrawingRoom() {
        for (String library :
                List.of("org.eclipse.elk..", "org.eclipse.emf..", "org.eclipse.xtext..", "com.google.common..")) {
            library(library, "io.troupe.petri.drawing");
        }
    }

    @Test
    void peers_stayInTheBenchmarks() {
        for (String peer : List.of("org.jctools..", "io.vertx..", "org.apache.pekko..", "org.nustaq..")) {
            library(peer, "io.troupe.bench..");
        }
    }

    @Test
    void picocli_staysInCommandLines() {
        library("picocli..", "io.troupe.demo..", "io.troupe.bench..");
    }

    @Test
    void jmh_staysInTheBenchmarks() {
        library("org.openjdk.jmh..", "io.troupe.bench..");
        noClasses()
                .should()
                .dependOnClassesThat()
                .resideInAPackage("org.openjdk.jmh..")
                .allowEmptyShould(true)
                .check(Classes.STRESS);
    }

    @Test
    void jcstress_staysInTheStressModule() {
        noClasses()
                .should()
                .dependOnClassesThat()
                .resideInAPackage("org.openjdk.jcstress..")
                .check(Classes.MAIN);
    }

    private static void library(String library, String... rooms) {
        noClasses()
                .that()
                .resideOutsideOfPackages(rooms)
                .should()
                .dependOnClassesThat()
                .resideInAPackage(library)
                .check(Classes.MAIN);
    }
}
