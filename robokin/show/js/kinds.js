// Written by `python tests/javascript.py types` from PageThing in things/__init__.py.

import {faces} from "./faces.js";
import {mark} from "./mark.js";
import {target} from "./target.js";
import {zone} from "./zone.js";

/** The kinds of things, in the order in which they are drawn. */
export const kinds = {faces, zone, mark, target};
