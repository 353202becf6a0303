r"""25 texts that are more than texts in one language or another, by name."""

RAN = "burmester_ran_this"  # what a payload would leave behind if anything ran it

PAYLOADS = {
    "a line end": f"crank\nopen('{RAN}', 'w').close()",
    "CRLF": f"crank\r\nopen('{RAN}', 'w').close()\r\n",
    "triple quotes": f'"""\nopen("{RAN}", "w").close()\n"""',
    "other triple quotes": f"'''\nopen('{RAN}', 'w').close()\n'''",
    "quotes": f'"); system("touch {RAN}"); ("',
    "single quotes": f"'); open('{RAN}', 'w'); ('",
    "a backslash at the end": "crank\\",
    "backslashes": '\\" \\n \\x22 \\N{QUOTATION MARK} \\',
    "the end of a comment": "--> <evil/> <!--",
    "hyphens at the end": "crank---",
    "the end of CDATA": "]]><evil/><![CDATA[",
    "an include": f'"/><include file="{RAN}"/><x y="',
    "an entity": "&evil; &#0; &lt; %evil;",
    "a script": f"</title></svg></script><script>window.{RAN}=1</script>",
    "groups of DXF": "crank\n0\nENDSEC\n0\nEOF",
    "codes of DXF": r"%%c %%u%%065 \U+0022 \M+1A0A0 ^J ^ {\fArial;} \P",
    "OpenSCAD": f"crank\n*/ include <{RAN}.scad>\ncube(1); /*",
    "a formula of TeX": r"$\frac{$ \input{x} $$",
    "a format": "{0.__class__} {chosen} %(id)s %s %n {",
    "a template": f"${{{RAN}}} `touch {RAN}` $(touch {RAN}) <%= 1 %>",
    "codes of a terminal": "\x1b[2J\x1b]0;owned\x07 \x9b31m \x08\x7f",
    "direction turned round": "\u202egnp.\u2066exe\u200f",
    "foreign line ends": "a\u2028b\u2029c\x85d\x0be\x0cf",
    "null and half characters": "a\0b\ud800c\udc80\ufffe\uffff\U000e0041",
    "a long text": "a very long name, " * 6000,
}
