package io.troupe.petri.drawing;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.w3c.dom.Element;

/** Asserts that the nodes of a picture are visible and do not overlap. */
final class Overlaps {
    private Overlaps() {}

    static void requireApart(Picture picture, List<Element> nodes, String what) {
        var boxes = nodes.stream().map(Picture::box).toList();
        for (var i = 0; i < boxes.size(); i++) {
            assertThat(picture.viewBox().contains(boxes.get(i)))
                    .as(what + ": " + Picture.title(nodes.get(i)) + " is inside")
                    .isTrue();
            for (var j = 0; j < i; j++) {
                assertThat(boxes.get(i).overlaps(boxes.get(j)))
                        .as(what + ": " + Picture.title(nodes.get(i)) + " overlaps " + Picture.title(nodes.get(j)))
                        .isFalse();
            }
        }
    }
}
