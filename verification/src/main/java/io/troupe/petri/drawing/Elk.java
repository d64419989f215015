package io.troupe.petri.drawing;

import java.util.function.Supplier;

/** The Eclipse Layout Kernel, which places what is drawn. It is not brought along, because proofs do not need it. */
final class Elk {
    private static final String ARTIFACTS =
            "org.eclipse.elk:org.eclipse.elk.alg.layered and" + " org.eclipse.xtext:org.eclipse.xtext.xbase.lib";

    private Elk() {}

    /** A drawing, or an error that names what is missing on the class path. */
    static String drawn(Supplier<String> svg) {
        try {
            return svg.get();
        } catch (NoClassDefFoundError missing) {
            throw new IllegalStateException(
                    "an SVG drawing needs " + ARTIFACTS + " on the class path, which troupe-verification does not bring"
                            + " along; dot() needs neither",
                    missing);
        }
    }
}
