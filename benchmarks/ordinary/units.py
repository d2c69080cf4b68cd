"""An input in other units: the same problem with all lengths, stresses and what follows from them scaled."""
import re

LENGTHS = {'Lower corner', 'Upper corner', 'Centre', 'Radius', 'Inner radius', 'Point', 'Semi-axes', 'First point',
           'Second point', 'Vertices', 'Rotation centre', 'Translation', 'Start', 'End', 'Reference point', 'Adjust'}
STRESSES = {"Young's modulus", 'Yield stress', 'Hardening modulus', 'Penalty modulus'}
# Formulas by the unit of their values, as exponents of stress and length in two dimensions.
FORMULAS = {'Body force': (1, -1), 'Expression': (0, 1), 'Cell size limit': (0, 1), 'Where': (0, 0),
            'Displacement x': (0, 1), 'Displacement y': (0, 1), 'Force x': (1, 1), 'Force y': (1, 1),
            'Moment': (1, 2)}
OF_CONDITION = {'displacement': (0, 1), 'mean support': (0, 1), 'point support': (0, 1), 'traction': (1, 0),
                'pressure': (1, 0), 'spring': (1, -1)}


def scaled_numbers(text, factor):
    return re.sub(r'[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?', lambda m: '%.17g' % (float(m.group()) * factor), text)


def scaled_formula(text, length, factor):
    """factor * f(x / length, ...), component by component."""
    def component(formula):
        formula = re.sub(r'\b([xyz])\b', lambda m: '(%s/%.17g)' % (m.group(), length), formula.strip())
        return '%.17g*(%s)' % (factor, formula)
    return '; '.join(component(formula) for formula in text.split(';'))


def lines_in_sections(lines):
    """Each line with the path of subsections in which it stands."""
    path = []
    for line in lines:
        words = line.split('#')[0].split()
        if words[:1] == ['subsection']:
            path.append(' '.join(words[1:]))
        elif words == ['end']:
            path.pop()
        yield line, tuple(path)


def in_units(text, length, stress):
    """The parameter file `text` with lengths times `length` and stresses times `stress`; two-dimensional."""
    lines = re.sub(r'\\\s*\n', ' ', text).splitlines()  # continued lines as one
    types = {}
    for line, path in lines_in_sections(lines):  # of the boundary conditions, may stand after their values
        match = re.match(r'\s*set\s+Type\s*=\s*(.*?)\s*(#.*)?$', line)
        if match:
            types[path] = match.group(1)
    result = []
    for line, path in lines_in_sections(lines):
        match = re.match(r'(\s*set\s+)(.*?)\s*=\s*(.*?)\s*(#.*)?$', line)
        if match:
            start, key, value = match.group(1), match.group(2), match.group(3)
            units = FORMULAS.get(key)
            if key == 'Value' and 'Boundary conditions' in path:
                units = OF_CONDITION[types.get(path, 'displacement')]
            if key in LENGTHS:
                value = scaled_numbers(value, length)
            elif key in STRESSES:
                value = scaled_numbers(value, stress)
            elif units:
                value = scaled_formula(value, length, stress ** units[0] * length ** units[1])
            line = '%s%s = %s' % (start, key, value)
        result.append(line)
    return '\n'.join(result) + '\n'
