"""What the benchmark scripts share: reading results, fits, integrals of curves, tables."""
import csv
import datetime
import glob
import os
import re
import resource
import subprocess
import sys
import threading

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'contrib'))
from plotting.pairs import with_pair_columns


def read_csv(path):
    """A CSV file as a dictionary of columns; columns of numbers become arrays."""
    with open(path) as file:
        rows = list(csv.reader(file))
    columns = {}
    for i, name in enumerate(rows[0]):
        values = [row[i] for row in rows[1:]]
        try:
            columns[name] = np.array(values, float)
        except ValueError:
            columns[name] = np.array(values)
    return columns


def read_history(results):
    """history.csv, with the columns of pairs that it leaves out when there are many."""
    return with_pair_columns(results, read_csv(os.path.join(results, 'history.csv')))


def last_contact(results, step=None):
    """The contact points of a step (default: the last written), sorted by x."""
    files = sorted(glob.glob(os.path.join(results, 'contact_*.csv')))
    path = files[-1] if step is None else os.path.join(results, 'contact_%04d.csv' % step)
    contact = read_csv(path)
    order = np.argsort(contact['x'], kind='stable')
    return {name: column[order] for name, column in contact.items()}


def ellipse_fit(x, p, half_width):
    """Peak and half width of p^2 = p0^2 (1 - x^2/a^2), fitted on |x| < 0.7 half_width."""
    inner = np.abs(x) < 0.7 * half_width
    matrix = np.stack([np.ones(inner.sum()), -x[inner] ** 2], 1)
    c0, c1 = np.linalg.lstsq(matrix, p[inner] ** 2, rcond=None)[0]
    return np.sqrt(c0), np.sqrt(c0 / c1)


def oscillation(x, p, half_width, peak, degree=6):
    """Root mean square of p around a smooth polynomial fit on |x| < 0.7 half_width, over the peak."""
    inner = np.abs(x) < 0.7 * half_width
    fit = np.polynomial.Polynomial.fit(x[inner], p[inner], degree)
    return np.sqrt(np.mean((p[inner] - fit(x[inner])) ** 2)) / peak


def relative_l2(x, weight, value, x_reference, reference, low=-np.inf, high=np.inf):
    """|value - reference| / |reference| in L2 by the quadrature weights, on low < x < high."""
    inside = (x > low) & (x < high)
    expected = np.interp(x[inside], x_reference, reference)
    w = weight[inside]
    return np.sqrt(np.sum(w * (value[inside] - expected) ** 2) / np.sum(w * expected ** 2))


def print_table(header, rows):
    """Markdown table; numbers with 6 digits."""
    def text(value):
        return value if isinstance(value, str) else '%.6g' % value
    cells = [[text(value) for value in row] for row in [header] + rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    for number, row in enumerate(cells):
        print('| ' + ' | '.join(value.ljust(width) for value, width in zip(row, widths)) + ' |')
        if number == 0:
            print('|' + '|'.join('-' * (width + 2) for width in widths) + '|')


def run_scree(binary, prm, results, settings=()):
    """Runs scree with settings 'Section/Key=value'; the unknowns and the CPU seconds."""
    command = [binary, prm, '--output', results]
    for setting in settings:
        command += ['--set', setting]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          stdin=subprocess.DEVNULL, env=dict(os.environ, OMP_NUM_THREADS='1'))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(' '.join(command) + '\n' + done.stdout)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {'unknowns': int(re.search(r'Unknowns: (\d+)', done.stdout).group(1)),
            'seconds': seconds}


def run_limited(binary, prm, results, limit, processes=1):
    """The output of a run, none if it took too long, CPU seconds, and the peak memory of its largest process in MB."""
    command = [binary, str(prm), '--output', str(results)]
    if processes > 1:
        command = ['mpirun', '--oversubscribe', '-np', str(processes)] + command
    with open(str(results) + '.txt', 'w+', encoding='utf-8') as output:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                   env=dict(os.environ, OMP_NUM_THREADS='1'))
        timer = threading.Timer(limit, process.terminate)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    if process.returncode != 0 and 'scree: ' in text:
        sys.exit(text)
    is_done = process.returncode == 0 and 'Finished in' in text
    return (text if is_done else None), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def print_study_end(seconds='CPU seconds of the whole run on one core'):
    """Date and machine class under a table, and what its seconds are."""
    print('\nMeasured %s on 2 cores, x86-64; %s.' % (datetime.date.today().isoformat(), seconds))
